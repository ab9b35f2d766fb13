// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "constraints/rigid/rigid_judge.h"
#include "core/contact/robot_pose.h"
#include "planners/rigid/rigid_world.h"

namespace phongpd::internal {

// The penetration depth at a pose of the two meshes that a check found to
// meet, user's unit; none: not both are solids, they only touch, or it is not
// known within a second.
std::optional<double> DepthAtEnd(const RigidWorld& world,
                                 const RigidCheck& check,
                                 const RobotPose& pose);

}  // namespace phongpd::internal
