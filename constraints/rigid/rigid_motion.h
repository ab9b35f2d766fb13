// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/contact/robot_pose.h"

namespace phongpd {

// A robot that translates and turns at once, t ∈ [0, 1], about its own origin:
//
//   x(t) = R(t) p + q(t),   R(t) = exp(t [ω]) R_a,   q(t) = (1 − t) q_a + t q_b
//
// for a point p of the robot in its own frame.  R_a is the rotation of the
// start's quaternion, divided by its exact length.  RigidJudge judges exactly
// these formulas, with start(), turn() and end().position (rigid_judge.h).
class RigidMotion {
 public:
  // The largest turn; rounding grows with it.
  static constexpr double kMaxTurn = 1e3;  // radians

  // From pose to pose by the shorter turn: |ω| ≤ π.  Within 1e-12 rad of half a
  // turn both ways are equally long: then the axis is the one whose first
  // coordinate with an absolute value above 1e-6 is positive; for the other one
  // use Turning.  R(1) is the given orientation to 1e-14 rad.  Throws
  // InputError for poses that are not finite, or whose quaternion is not of
  // unit length (CheckPose).
  RigidMotion(const RobotPose& start, const RobotPose& end);

  // The same for matrices.  Throws InputError for one whose linear part is not
  // a rotation, to 1e-9; the message says what is wrong, and by how much.
  RigidMotion(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end);

  // By the rotation vector ω = θ u, radians, in the frame of the obstacles,
  // |ω| ≤ kMaxTurn: for the longer way, and for turns of more than once around.
  // Throws like the first.
  static RigidMotion Turning(const RobotPose& start,
                             const Eigen::Vector3d& end_position,
                             const Eigen::Vector3d& turn);

  const RobotPose& start() const { return start_; }
  // Its position is exact, its orientation is rounded.
  const RobotPose& end() const { return end_; }
  const Eigen::Vector3d& turn() const { return turn_; }  // ω
  double angle() const { return angle_; }                // θ = |ω| ≥ 0
  // u; (1, 0, 0) if the motion does not turn.
  const Eigen::Vector3d& axis() const { return axis_; }

  // The pose at t ∈ [0, 1], to rounding.
  RobotPose At(double t) const;

 private:
  RigidMotion() = default;
  void SetTurn(const Eigen::Vector3d& turn);

  RobotPose start_, end_;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();
  double angle_ = 0.0;
};

// The matrix as a pose.  Throws InputError "<what>: …" unless it is finite and
// its linear part is a rotation: RᵀR = 1 to 1e-9 in every entry, and det R > 0.
RobotPose PoseOf(const Eigen::Isometry3d& matrix, const std::string& what);

}  // namespace phongpd
