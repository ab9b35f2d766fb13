// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/contact/depth.h"

namespace phongpd {

// A robot that translates and turns at once, t ∈ [0, 1], about its own origin:
//
//   x(t) = R(t) p + q(t),   R(t) = exp(t [ω]) R_a,   q(t) = (1 − t) q_a + t q_b
//
// for a point p of the robot at rest; R_a is the rotation of the start's
// quaternion, divided by its exact length.  These formulas of start(), turn()
// and end().position are what is judged (rigid_judge.h).
class RigidMotion {
 public:
  // More than whole turns are of use to nobody, and rounding grows with them.
  static constexpr double kMaxTurn = 1e3;  // radians

  // From pose to pose, the shorter way round: |ω| ≤ π.  Where both ways are as
  // long, within 1e-12 rad of half a turn, the axis is the one whose first
  // coordinate above 1e-6 is positive; whoever wants the other one says so
  // below.  R(1) is the given orientation to 1e-14 rad.  Throws InputError for
  // poses that are not finite or not of a unit quaternion (CheckPose).
  RigidMotion(const RobotPose& start, const RobotPose& end);

  // A matrix is no quaternion: refused if it is no rotation, to 1e-9, which
  // the message says by how much, in which way.
  RigidMotion(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end);

  // By the vector of the turn ω = θ u, radians, in the frame of the obstacles,
  // |ω| ≤ kMaxTurn: whole turns and the longer way.  Throws as above.
  static RigidMotion Turning(const RobotPose& start,
                             const Eigen::Vector3d& end_position,
                             const Eigen::Vector3d& turn);

  const RobotPose& start() const { return start_; }
  // To rounding, as for the orientation; its position is exact.
  const RobotPose& end() const { return end_; }
  const Eigen::Vector3d& turn() const { return turn_; }  // ω
  double angle() const { return angle_; }                // θ = |ω| ≥ 0
  // u; (1, 0, 0) of a motion that does not turn.
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
// its linear part a rotation, RᵀR = 1 to 1e-9 in every entry and det R > 0.
RobotPose PoseOf(const Eigen::Isometry3d& matrix, const std::string& what);

}  // namespace phongpd
