// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/contact/robot_pose.h"

// Derivatives of turns.  A small turn δ of a rotation is exp([δ]) R, in the
// frame of the obstacles; radians.
namespace phongpd::internal {

// [v], with [v] x = v × x.
Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v);

// J with exp([w + d]) = exp([J d]) exp([w]) to first order in d; at any w.
Eigen::Matrix3d TurnJacobian(const Eigen::Vector3d& w);

// Its inverse, for |w| < 2π.
Eigen::Matrix3d InverseTurnJacobian(const Eigen::Vector3d& w);

// The pose at t ∈ [0, 1] of the shorter motion between two (rigid_motion.h),
//
//   q(t) = (1 − t) q_a + t q_b,   R(t) = exp(t [ω]) R_a,   exp([ω]) R_a = R_b,
//
// and how it turns, by A δ_a + B δ_b, when the ends turn by δ_a and δ_b: the
// position is linear.  Where the motion turns by half a turn ω jumps.
struct PoseBetween {
  PoseBetween(const RobotPose& a, const RobotPose& b, double t);

  RobotPose pose;
  Eigen::Matrix3d by_start, by_end;  // A, B
};

}  // namespace phongpd::internal
