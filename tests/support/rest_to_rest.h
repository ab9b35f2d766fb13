// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

namespace phongpd::testing {

// Least time of a motion of that length from rest to rest: as fast as it gets,
// and straight back to rest.  The top speed is found by halving.
inline double RestToRest(double length, double v, double a, double j) {
  // To a speed, or from it, at most jerk and acceleration.
  const auto ramp = [&](double speed) {
    return speed * j >= a * a ? speed / a + a / j : 2.0 * std::sqrt(speed / j);
  };
  if (v * ramp(v) <= length) return 2.0 * ramp(v) + (length - v * ramp(v)) / v;
  double low = 0.0, high = v;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * ramp(middle) < length ? low : high) = middle;
  }
  return 2.0 * ramp(low);
}

}  // namespace phongpd::testing
