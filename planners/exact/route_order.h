// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace phongpd {

// Of a clearance that is to be kept: solvers keep their constraints to within
// 1e-6.
inline constexpr double kKeptOfClearance = 1.0 - 1e-6;

// Which of two free paths is the better one, for all planners that compare
// routes: one that stays free whatever rounding did to the surface before one
// that may not (clearance > rounding), then the shorter one, where a
// clearance of less than 0.7 of the other's costs a tenth of the length.  Where
// a clearance is to be kept, one that keeps it or more of it comes first.
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
  explicit RouteOrder(double rounding, double kept_clearance = 0.0)
      : rounding_(rounding), kept_clearance_(kept_clearance) {}

  bool IsCertain(double clearance) const { return clearance > rounding_; }

  // Is `a` better than `b`?
  bool IsBetter(const Route& a, const Route& b) const {
    const bool is_certain = IsCertain(a.clearance);
    if (is_certain != IsCertain(b.clearance)) return is_certain;
    const double kept = KeptBy(a), kept_by_other = KeptBy(b);
    if (kept != kept_by_other) return kept > kept_by_other;
    return Cost(a, b) < Cost(b, a);
  }

 private:
  double KeptBy(const Route& a) const {
    return std::min(a.clearance, kKeptOfClearance * kept_clearance_);
  }

  // The length that `a` counts beside `b`.
  static double Cost(const Route& a, const Route& b) {
    constexpr double kMuchLess = 0.7;
    constexpr double kWorth = 0.9;
    return a.clearance < kMuchLess * b.clearance ? a.length / kWorth : a.length;
  }

  double rounding_ = 0.0, kept_clearance_ = 0.0;
};

}  // namespace phongpd
