// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/rigid/rigid_motion.h"
#include "constraints/rigid/rigid_tree.h"

// Boxes and triangles of a robot in rigid motion against fixed ones, on parts
// [t − h, t + h] of the way, in the frame of the judge: where the meshes are of
// a size near 1.
//
// The certificate.  With a = x(t) − q(t) the arm of a point of the robot at the
// middle, ẋ = Δq + ω × a, and ρ its distance from the axis u,
//
//   |n · (x(t + s) − x(t) − s ẋ)| ≤ ½ s² θ² |n × u| ρ,                     (1)
//
// since the second derivative is θ² long times the arm across the axis.  So a
// direction n parts a triangle of the robot from one of the obstacles for all
// |s| ≤ h if, over their corners,
//
//   min_i [ n·x_i − h |n·ẋ_i| − ½ h² θ² |n × u| ρ_i ] − max_j n·b_j > slack (2)
//
// or the same with −n.  For a box of centre c and radius r the speed of its
// points differs from the centre's by |n × u| θ r at most.
//
// Rounding.  All is in units u = 2⁻⁵³ of S, the sum of the robot's reach from
// its origin, of how far that gets, and of the obstacles' reach, everything in
// the frame; a direction is 1 long to 4 u.  Then
//   corners into the frame, q, Δq and q(t)           ≤ 8
//   R(t) by a quaternion, sine and cosine            ≤ 48 + 4 θ
//   R p + q                                          ≤ 8
//   dot products with n, both sides                  ≤ 16
//   h n·ẋ with h ≤ ½, its arm and ω of the above     ≤ 16 + 40 θ + 2 θ²
//   the last term of (2), ρ and |n × u| rounded up   ≤ 20 θ²
// are less than 128 (1 + θ)², and slack is 2⁻⁴⁴ S (1 + θ)², four times as much.
// The rest holds the rounding of the logarithm of the turn, too, so that the
// motion between the given orientations is as free as that of the formula.
namespace phongpd::internal {

// Robot and obstacles are p·scale and (b − center)·scale there; the scale is a
// power of two.
struct RigidFrame {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;
};

struct RigidPose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d position;
};

// A motion in the frame.
class FramedMotion {
 public:
  // `reach` of robot and of obstacles, there.
  FramedMotion(const RigidMotion& motion, const RigidFrame& frame,
               double robot_reach, double obstacle_reach);

  RigidPose At(double t) const;

  const Eigen::Vector3d& moved() const { return moved_; }          // Δq
  double distance() const { return distance_; }                    // |Δq|
  const Eigen::Vector3d& axis() const { return axis_; }            // u
  const Eigen::Vector3d& turn() const { return turn_; }            // ω
  double angle() const { return angle_; }                          // θ
  const Eigen::Vector3d& body_axis() const { return body_axis_; }  // R_aᵀ u
  double slack() const { return slack_; }
  double size() const { return size_; }  // S

  // Of a point of the robot: ρ, rounded up.
  double FromAxis(const Eigen::Vector3d& p) const;
  // |n × u| of a direction, rounded up.
  double AcrossAxis(const Eigen::Vector3d& n) const;

 private:
  Eigen::Quaterniond start_;
  Eigen::Vector3d position_, moved_, axis_, turn_, body_axis_;
  double angle_, distance_, size_, slack_;
};

// What a pair shows on a part of the way.
enum class PairSight {
  kApart,    // on all of it: proved
  kMeet,     // at its middle: proved
  kUnknown,  // neither
};

// Of two boxes; never kMeet.  *motion_bound is how far a point of the robot's
// box gets from where it is at the middle, at most.
PairSight LookAtBoxes(const FramedMotion& motion, const RigidPose& middle,
                      double half_width, const RigidNode& robot,
                      const RigidNode& obstacle, double* motion_bound);

// Of two triangles.  They meet if an edge of one runs through the inside of the
// other, and would if each corner were 8 slack away: touching is unknown.
PairSight LookAtTriangles(const FramedMotion& motion, const RigidPose& middle,
                          double half_width, const TriangleCorners& robot,
                          const TriangleCorners& obstacle,
                          double* motion_bound);

}  // namespace phongpd::internal
