// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planners/rigid/optimizer/rigid_optimize.h"

// Paths that optimisers begin with.
namespace phongpd::internal {

// The straight motion with request.knots poses between its ends, free or not,
// moved at random by request.start_noise and kept within `bounds`.
std::vector<RobotPose> StraightStart(const RigidWorld& world,
                                     const RigidOptimizeRequest& request,
                                     const Eigen::AlignedBox3d& bounds);

// Links are halved, the longest first, until there are so many knots between
// the ends.  The same motions, to rounding.
std::vector<RobotPose> WithKnots(std::vector<RobotPose> path, int knots,
                                 const RigidWorld& world);

}  // namespace phongpd::internal
