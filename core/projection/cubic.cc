// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/cubic.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace phongpd {

namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

double Value(const Cubic& c, double s) {
  return ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
}

double Slope(const Cubic& c, double s) {
  return (3.0 * c[3] * s + 2.0 * c[2]) * s + c[1];
}

// Bound of the rounding error of Value.
double Rounding(const Cubic& c, double s) {
  const double t = std::abs(s);
  return 4.0 * kEpsilon *
         (((std::abs(c[3]) * t + std::abs(c[2])) * t + std::abs(c[1])) * t +
          std::abs(c[0]));
}

// Zeros of the derivative in (low, high), ascending, without cancellation.
int CriticalPoints(const Cubic& c, double low, double high, double* point) {
  const double a = 3.0 * c[3], half_b = c[2], d = c[1];
  const double discriminant = half_b * half_b - a * d;
  if (!(discriminant >= 0.0)) return 0;
  const double m = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  int count = 0;
  // Quotients overflow to infinity or are NaN when a coefficient vanishes;
  // the comparisons drop both.
  for (const double s : {m / a, d / m}) {
    if (s > low && s < high) point[count++] = s;
  }
  if (count == 2 && point[1] < point[0]) std::swap(point[0], point[1]);
  if (count == 2 && point[1] == point[0]) count = 1;
  return count;
}

// The root between a and b, where the cubic is monotone and changes sign.
double RootInBracket(const Cubic& c, double a, double b, double value_a,
                     double value_b) {
  if (value_a > 0.0) {
    std::swap(a, b);
    std::swap(value_a, value_b);
  }
  double s = a + (b - a) * (value_a / (value_a - value_b));
  if (!(s >= std::min(a, b) && s <= std::max(a, b))) s = 0.5 * (a + b);
  double last_step = std::abs(b - a);
  for (int i = 0; i < 200; ++i) {
    const double value = Value(c, s);
    // Nearer to zero than the value is known.
    if (std::abs(value) <= 0.25 * Rounding(c, s)) return s;
    (value < 0.0 ? a : b) = s;
    double next = s - value / Slope(c, s);
    const bool in_bracket = next > std::min(a, b) && next < std::max(a, b);
    if (!in_bracket || std::abs(next - s) > 0.5 * last_step) {
      next = 0.5 * (a + b);
    }
    last_step = std::abs(next - s);
    if (last_step <= kEpsilon * std::abs(next)) return next;
    s = next;
  }
  return s;
}

// What the Bernstein form says of the roots in [low, high].
enum class Expected { kNone, kOne, kAny };

// Coefficients of the Bernstein form bound the values, and those of the
// derivative its values: no root if all of the first have the same sign by
// more than rounding; one if the ends differ and the second do not.
Expected ExpectRoots(const Cubic& c, double low, double high, double at_low,
                     double at_high) {
  const double size = high - low, third = size / 3.0;
  const double slope_low = Slope(c, low), slope_high = Slope(c, high);
  const double b1 = at_low + third * slope_low;
  const double b2 = at_high - third * slope_high;
  const double margin = 4.0 * (Rounding(c, low) + Rounding(c, high));
  const double least = std::min({at_low, b1, b2, at_high});
  const double most = std::max({at_low, b1, b2, at_high});
  if (least > margin || most < -margin) return Expected::kNone;
  if (!(std::min(at_low, at_high) < 0.0 && std::max(at_low, at_high) > 0.0)) {
    return Expected::kAny;
  }
  const double middle = slope_low + size * (3.0 * c[3] * low + c[2]);
  const double s = std::max(std::abs(low), std::abs(high));
  const double slope_margin =
      16.0 * kEpsilon *
      ((3.0 * std::abs(c[3]) * s + 2.0 * std::abs(c[2])) * s + std::abs(c[1]));
  return std::min({slope_low, middle, slope_high}) > slope_margin ||
                 std::max({slope_low, middle, slope_high}) < -slope_margin
             ? Expected::kOne
             : Expected::kAny;
}

}  // namespace

CubicRoots SolveCubic(const Cubic& c, double low, double high) noexcept {
  CubicRoots roots;
  const double total =
      std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) + std::abs(c[3]);
  if (!(total > 0.0 && std::isfinite(total) && low <= high)) return roots;
  const double at_low = Value(c, low), at_high = Value(c, high);
  switch (ExpectRoots(c, low, high, at_low, at_high)) {
    case Expected::kNone:
      return roots;
    case Expected::kOne:
      roots.count = 1;
      roots.root[0] = RootInBracket(c, low, high, at_low, at_high);
      return roots;
    case Expected::kAny:
      break;
  }
  double point[4] = {low};
  const int inner = CriticalPoints(c, low, high, point + 1);
  const int last = inner + 1;
  point[last] = high;
  double value[4];
  for (int i = 0; i <= last; ++i) value[i] = Value(c, point[i]);

  const auto add = [&roots](double s) {
    if (roots.count < 3) roots.root[roots.count++] = s;
  };
  bool crossed = false;  // in the segment that ends at point[i]
  for (int i = 0; i <= last; ++i) {
    const bool crosses = i < last && ((value[i] < 0.0 && value[i + 1] > 0.0) ||
                                      (value[i] > 0.0 && value[i + 1] < 0.0));
    const bool is_critical = i > 0 && i < last;
    if (value[i] == 0.0 || (is_critical && !crossed && !crosses &&
                            std::abs(value[i]) <= Rounding(c, point[i]))) {
      add(point[i]);
    }
    if (crosses) {
      add(RootInBracket(c, point[i], point[i + 1], value[i], value[i + 1]));
    }
    crossed = crosses;
  }
  return roots;
}

CubicRoots SolveCubic(const Cubic& c) noexcept {
  for (const double coefficient : c) {
    if (!std::isfinite(coefficient)) return {};
  }
  int degree = 3;
  while (degree > 0 && c[degree] == 0.0) --degree;
  if (degree == 0) return {};

  // Substitute s = 2^k t with k such that all roots have |t| < 1 (Fujiwara's
  // bound), in exponents, so that neither step can overflow.
  int exponent[4];
  double log_bound = -1e9;
  for (int i = 0; i <= 3; ++i) {
    const double ci = c[i];
    exponent[i] = ci == 0.0 ? -100000 : std::ilogb(ci);
    if (ci != 0.0 && i < degree) {
      const double ratio =
          std::log2(std::abs(ci)) - std::log2(std::abs(c[degree]));
      log_bound = std::max(log_bound, ratio / (degree - i));
    }
  }
  const int k =
      log_bound < -1e8 ? 0 : static_cast<int>(std::ceil(log_bound)) + 2;
  int top = -100000;
  for (int i = 0; i <= degree; ++i) top = std::max(top, exponent[i] + i * k);
  Cubic scaled{};
  for (int i = 0; i <= degree; ++i) {
    scaled[i] = std::ldexp(c[i], i * k - top);
  }
  CubicRoots roots = SolveCubic(scaled, -1.0, 1.0);
  for (double& root : roots.root) root = std::ldexp(root, k);
  return roots;
}

}  // namespace phongpd
