// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact/robot_pose.h"

#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

constexpr double kUnitLength = 1e-9;

}  // namespace

void CheckPose(const RobotPose& pose, const std::string& what) {
  const Eigen::Vector4d& q = pose.orientation.coeffs();
  if (!pose.position.allFinite() || !q.allFinite()) {
    throw InputError(what + ": expected a finite pose, found NaN or infinity");
  }
  if (!(std::abs(q.stableNorm() - 1.0) <= kUnitLength)) {
    throw InputError(
        what + ": expected a unit quaternion (to 1e-9), found length " +
        FormatDouble(q.stableNorm()) + "; divide it by its length");
  }
}

}  // namespace phongpd
