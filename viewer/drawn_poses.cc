// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/drawn_poses.h"

#include <algorithm>
#include <cmath>

#include "constraints/rigid/rigid_motion.h"
#include "core/pi.h"

namespace phongpd {

std::vector<RobotPose> DrawnPoses(const std::vector<RobotPose>& poses) {
  constexpr double kTurn = 3.0 * kPi / 180.0;
  std::vector<RobotPose> drawn;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const RigidMotion motion(poses[i], poses[i + 1]);
    const double steps = std::ceil(std::max(1.0, motion.angle() / kTurn));
    for (double k = 0.0; k < steps; ++k) drawn.push_back(motion.At(k / steps));
  }
  if (!poses.empty()) drawn.push_back(poses.back());
  return drawn;
}

}  // namespace phongpd
