// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/curve_rests.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Without any an axis would be there at once.
void CheckAxes(const MotionLimits& limits) {
  for (int axis = 0; axis < (limits.by_norm ? 1 : 3); ++axis) {
    if (std::min({limits.velocity[axis], limits.acceleration[axis],
                  limits.jerk[axis]}) < MotionLimits::kNone) {
      continue;
    }
    throw InputError(
        "limits: expected one of velocity, acceleration and jerk at least" +
        (limits.by_norm ? std::string() : std::string(" of ") + "xyz"[axis]) +
        ", found none: it would be there at once");
  }
}

// Within the limits there, and when the acceleration has faded as fast as it
// can: towards the end of the motion, or backwards in time (`sign` −1).
void CheckEnd(const CurveEnd& end, const MotionLimits& limits, double sign,
              const std::string& name) {
  const auto fail = [&](const std::string& what, const std::string& range,
                        double value) {
    throw InputError("curve: " + name + " " + what + ": expected " + range +
                     ", found " + FormatDouble(value));
  };
  if (!IsFinite(end.velocity) || !IsFinite(end.acceleration)) {
    throw InputError("curve: " + name +
                     " velocity and acceleration: expected finite numbers, "
                     "found NaN or Inf");
  }
  const auto check = [&](const std::string& axis, double v, double a,
                         double later, int k) {
    if (v > limits.velocity[k]) {
      fail("velocity" + axis,
           "at most the limit, " + FormatDouble(limits.velocity[k]), v);
    }
    if (a > limits.acceleration[k]) {
      fail("acceleration" + axis,
           "at most the limit, " + FormatDouble(limits.acceleration[k]), a);
    }
    if (later > limits.velocity[k]) {
      fail("acceleration" + axis,
           "one that can fade before the velocity passes its limit, " +
               FormatDouble(limits.velocity[k]) + " (it passes " +
               Rounded(later) + ")",
           a);
    }
  };
  const auto later = [&](const Vector3d& v, const Vector3d& a, double jerk) {
    const double size = a.norm();
    return Vector3d(sign * v + (0.5 * size / jerk) * a);
  };
  const Vector3d &v = end.velocity, &a = end.acceleration;
  if (limits.by_norm) {
    check("", v.norm(), a.norm(), later(v, a, limits.jerk[0]).norm(), 0);
    return;
  }
  for (int k = 0; k < 3; ++k) {
    const Vector3d of_axis = later(v[k] * Vector3d::UnitX(),
                                   a[k] * Vector3d::UnitX(), limits.jerk[k]);
    check(std::string(" of ") + "xyz"[k], std::abs(v[k]), std::abs(a[k]),
          std::abs(of_axis[0]), k);
  }
}

void CheckVia(const CurveVia& via, std::size_t number) {
  const std::string which = "curve: via " + std::to_string(number) + ": ";
  if (!IsFinite(via.point)) {
    throw InputError(which + "expected a finite point, found NaN or Inf");
  }
  if (!(via.tolerance > 0.0) || !std::isfinite(via.tolerance)) {
    throw InputError(which + "expected a tolerance above 0, found " +
                     FormatDouble(via.tolerance));
  }
  if (!(via.dwell >= 0.0) || !std::isfinite(via.dwell)) {
    throw InputError(which + "expected a dwell of 0 seconds or more, found " +
                     FormatDouble(via.dwell));
  }
}

}  // namespace

void CurveOptions::Validate() const {
  limits.Validate();
  CheckAxes(limits);
  CheckEnd(start, limits, 1.0, "start");
  CheckEnd(end, limits, -1.0, "end");
  for (std::size_t i = 0; i < via.size(); ++i) CheckVia(via[i], i);
  CheckOption(duration >= 0.0 && std::isfinite(duration), "curve", "duration",
              "0 or a finite number of seconds", duration);
  if (duration > 0.0 &&
      (internal::HasRests(*this) || !start.IsAtRest() || !end.IsAtRest())) {
    throw InputError(
        "curve: duration: expected a start and an end at rest, and no dwell, "
        "where it is given");
  }
  CheckOption(margin >= 0.0 && std::isfinite(margin), "curve", "margin",
              "a finite length >= 0", margin);
  CheckOption(margin_price > 0.0 && std::isfinite(margin_price), "curve",
              "margin_price", "a finite share > 0", margin_price);
  CheckOption(time_limit > 0.0, "curve", "time_limit", "> 0 seconds",
              time_limit);
}

}  // namespace phongpd
