// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/contact/robot_pose.h"

// Displacements of a robot as vectors of six lengths, (v, L ω): v moves its
// origin, ω turns it about that, L is its radius of gyration (rigid_world.h).
namespace phongpd::internal {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// ω with exp([ω]) a = b and |ω| ≤ π; unit quaternions.
Eigen::Vector3d TurnBetween(const Eigen::Quaterniond& a,
                            const Eigen::Quaterniond& b);

// The pose moved by (v, L ω), of unit length again.
RobotPose Moved(const RobotPose& pose, const Vector6& move, double gyration);

// (v, L ω) from a to b, the shorter way round.
Vector6 Difference(const RobotPose& a, const RobotPose& b, double gyration);

// Its length.
double ObjectDistance(const RobotPose& a, const RobotPose& b, double gyration);

}  // namespace phongpd::internal
