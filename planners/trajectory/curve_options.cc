// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "core/mesh/mesh_error.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/curve_optimizer.h"

namespace phongpd {
namespace {

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

}  // namespace

const char* ToString(CurveEffort effort) {
  switch (effort) {
    case CurveEffort::kFast:
      return "fast";
    case CurveEffort::kBalanced:
      return "balanced";
    case CurveEffort::kTight:
      break;
  }
  return "tight";
}

const char* ToString(CurveStatus status) {
  switch (status) {
    case CurveStatus::kConverged:
      return "converged";
    case CurveStatus::kRoundLimit:
      return "round_limit";
    case CurveStatus::kTimeLimit:
      return "time_limit";
    case CurveStatus::kInterrupted:
      return "interrupted";
    case CurveStatus::kNotFree:
      break;
  }
  return "not_free";
}

void CurveOptions::Validate() const {
  limits.Validate();
  CheckAxes(limits);
  CheckOption(margin >= 0.0 && std::isfinite(margin), "curve", "margin",
              "a finite length >= 0", margin);
  CheckOption(time_limit > 0.0, "curve", "time_limit", "> 0 seconds",
              time_limit);
}

}  // namespace phongpd
