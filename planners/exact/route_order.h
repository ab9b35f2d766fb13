// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// Which of two free paths is the better one, for all planners that compare
// routes: one that stays free whatever rounding did to the surface before one
// that may not (clearance > rounding), then the shorter one, where a
// clearance of less than 0.7 of the other's costs a tenth of the length.
//
// Antisymmetric: of two paths never both are better, so that of two the same
// one wins whichever was found first.
class RouteOrder {
 public:
  struct Route {
    double length = 0.0;
    double clearance = 0.0;
  };

  // In the unit of lengths and clearances; ≥ 0.
  explicit RouteOrder(double rounding) : rounding_(rounding) {}

  bool IsCertain(double clearance) const { return clearance > rounding_; }

  // Is `a` better than `b`?
  bool IsBetter(const Route& a, const Route& b) const {
    const bool is_certain = IsCertain(a.clearance);
    if (is_certain != IsCertain(b.clearance)) return is_certain;
    return Cost(a, b) < Cost(b, a);
  }

 private:
  // The length that `a` counts beside `b`.
  static double Cost(const Route& a, const Route& b) {
    constexpr double kMuchLess = 0.7;
    constexpr double kWorth = 0.9;
    return a.clearance < kMuchLess * b.clearance ? a.length / kWorth : a.length;
  }

  double rounding_ = 0.0;
};

}  // namespace phongpd
