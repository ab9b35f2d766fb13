// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/contact/depth.h"

namespace phongpd {

// A robot that translates and turns at once, t ∈ [0, 1], about its own origin,
// by a quaternion that is linear in t and not divided by its length:
//
//   x(t) = M(p) p₀ / |p|² + q,   p = (1 − t) a + t b,   q = (1 − t) q_a + t q_b
//
// for a point p₀ of the robot at rest, M(p) v the vector of p v p̄.  These
// formulas, of the doubles a, b, q_a and q_b as they are, are the motion:
// whether two triangles meet under it is a matter of polynomials of degree 3 in
// t with rational coefficients, so that it is decided exactly
// (RigidJudge::CheckExactly).
//
// It goes through the orientations of RigidMotion from the same start to the
// same end, about the same axis, faster in the middle of the way: from a unit
// quaternion to another one at an angle Ω, half the turn,
//
//   φ' = 2 sin Ω / |p|²,   |p|² ≥ cos² ½Ω ≥ ½
class QuaternionMotion {
 public:
  // From pose to pose, the shorter way round: b is the end's quaternion, or its
  // negative where a·b < 0.  Throws InputError for poses that are not finite or
  // not of a unit quaternion (CheckPose).
  static QuaternionMotion Between(const RobotPose& start, const RobotPose& end);

  const RobotPose& start() const { return start_; }
  // Of the sign that a·b ≥ 0.
  const RobotPose& end() const { return end_; }

  // The pose at t ∈ [0, 1], to rounding.
  RobotPose At(double t) const;

 private:
  // Two poses in braces are a RigidMotion.
  QuaternionMotion() = default;

  RobotPose start_, end_;
};

}  // namespace phongpd
