// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/least_duration.h"

#include <algorithm>
#include <cmath>

namespace phongpd {
namespace {

double FromRestToRest(double d, double v, double a, double j) {
  if (!(d > 0.0)) return 0.0;
  // To speed up to v and slow down again.
  const double changing =
      v * j < a * a ? 2.0 * std::sqrt(v / j) : v / a + a / j;
  if (d >= v * changing) return changing + d / v;
  const double r = a / j;
  if (d >= 2.0 * a * r * r) return r + std::sqrt(r * r + 4.0 * d / a);
  return 4.0 * std::cbrt(d / (2.0 * j));
}

}  // namespace

double LeastDuration(const Eigen::Vector3d& way, const MotionLimits& limits,
                     bool from_rest_to_rest) {
  double least = 0.0;
  for (int k = 0; k < (limits.by_norm ? 1 : 3); ++k) {
    const double d = limits.by_norm ? way.norm() : std::abs(way[k]);
    const double v = limits.velocity[k];
    least = std::max(least, from_rest_to_rest
                                ? FromRestToRest(d, v, limits.acceleration[k],
                                                 limits.jerk[k])
                                : d / v);
  }
  return least;
}

}  // namespace phongpd
