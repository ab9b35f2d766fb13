// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/bvh/triangle_bvh.h"
#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Where a robot that touches an obstacle is near it, on average:
//
//   r̄ = ∫_{∂A} κ(g(x)/δ) x dA / ∫_{∂A} κ(g(x)/δ) dA,   κ(u) = (1 − u²)⁴, u < 1
//
// g(x) the distance of x from the obstacle's surface, x from the robot's
// origin.  By the midpoint rule over panels of δ/3 at most, the same ones of
// the robot at every pose.  Zero where no panel is within δ.
Eigen::Vector3d GapLever(const TriangleMesh& robot, const TriangleBvh& obstacle,
                         const RobotPose& pose, double delta);

}  // namespace phongpd::internal
