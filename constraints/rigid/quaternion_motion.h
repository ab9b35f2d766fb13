// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/contact/robot_pose.h"

namespace phongpd {

// A robot that translates and turns at once, t ∈ [0, 1], about its own origin,
// by a quaternion p that is linear in t and not normalised:
//
//   x(t) = M(p) p₀ / |p|² + q,   p = (1 − t) a + t b,   q = (1 − t) q_a + t q_b
//
// for a point p₀ of the robot in its own frame; M(p) v is the vector part of
// p v p̄.  The motion is defined by these formulas with the doubles a, b, q_a
// and q_b as they are.  So the times at which two triangles touch are roots of
// polynomials of degree 3 in t with rational coefficients, and collision can be
// decided exactly (RigidJudge::CheckExactly).
//
// It passes the same orientations as RigidMotion between the same poses, about
// the same axis, but turns faster in the middle.  From one unit quaternion to
// another at the angle Ω (half the angle of the turn), the angular velocity is
//
//   φ' = 2 sin Ω / |p|²,   |p|² ≥ cos² ½Ω ≥ ½
class QuaternionMotion {
 public:
  // From pose to pose by the shorter turn: b is the end's quaternion, or its
  // negative if a·b < 0.  Throws InputError for poses that are not finite, or
  // whose quaternion is not of unit length (CheckPose).
  static QuaternionMotion Between(const RobotPose& start, const RobotPose& end);

  const RobotPose& start() const { return start_; }
  // With the sign for which a·b ≥ 0.
  const RobotPose& end() const { return end_; }

  // The pose at t ∈ [0, 1], to rounding.
  RobotPose At(double t) const;

 private:
  // Private: two poses in braces, {a, b}, shall mean a RigidMotion.
  QuaternionMotion() = default;

  RobotPose start_, end_;
};

}  // namespace phongpd
