// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact/robot_pose.h"

namespace phongpd {

// A way of poses, between which the robot moves by RigidMotion, with as many
// between them as it takes for each to turn by at most 3 degrees.
std::vector<RobotPose> DrawnPoses(const std::vector<RobotPose>& poses);

}  // namespace phongpd
