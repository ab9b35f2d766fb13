// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/rigid/framed_motion.h"
#include "constraints/rigid/rigid_tree.h"

// Boxes and triangles of a robot in rigid motion against fixed ones, on parts
// [t − h, t + h] of the way, in the frame of the judge: where the meshes are of
// a size near 1.
//
// The certificate.  With a = x(t) − q(t) the arm of a point of the robot at the
// middle, ẋ = Δq + φ' u × a, and ρ its distance from the axis u,
//
//   |n · (x(t + s) − x(t) − s ẋ)| ≤ ½ s² β |n × u| ρ,                       (1)
//
// β = max (φ'² + |φ''|), since the second derivative is φ'² times the arm
// across the axis and φ'' times that turned by a quarter.  At a constant rate β
// = θ². So a direction n parts a triangle of the robot from one of the
// obstacles by more than a gap g for all |s| ≤ h if, over their corners,
//
//   min_i [ n·x_i − h |n·ẋ_i| − ½ h² β |n × u| ρ_i ] − max_j n·b_j > g + slack
//   (2)
//
// or the same with −n.  For a box of centre c and radius r the speed of its
// points differs from the centre's by |n × u| φ' r at most.
//
// Rounding.  All is in units u = 2⁻⁵³ of S, the sum of the robot's reach from
// its origin, of how far that gets, and of the obstacles' reach, everything in
// the frame; a direction is 1 long to 4 u.  Then
//   corners into the frame, q, Δq and q(t)           ≤ 8
//   corners along the axes of a box, and these       ≤ 24
//   R(t) by a quaternion, sine and cosine            ≤ 48 + 4 θ
//   R p + q                                          ≤ 8
//   dot products with n, both sides                  ≤ 16
//   h n·ẋ with h ≤ ½, its arm and ω of the above     ≤ 16 + 40 θ + 2 θ²
//   the last term of (2), ρ and |n × u| rounded up   ≤ 20 θ²
// are less than 128 (1 + θ)², and slack is 2⁻⁴⁴ S (1 + θ)², four times as much.
// The rest holds the rounding of the logarithm of the turn, too, so that the
// motion between the given orientations is as free as that of the formula.
// Here θ is the larger of max φ' and √β: of a constant rate the turn.
namespace phongpd::internal {

// What a pair shows on a part of the way.
enum class PairSight {
  kApart,    // by more than the gap on all of it: proved
  kMeet,     // at its middle: proved
  kUnknown,  // neither
};

// A direction that may part a pair, 1 long; 0: none is known.  Looking leaves
// the best one found there, for the next look at the pair, on a part of it.
using PairHint = Eigen::Vector3d;

// Of two boxes; never kMeet.  *motion_bound is how far a point of the robot's
// box gets from where it is at the middle, at most.
PairSight LookAtBoxes(const FramedMotion& motion, const RigidPose& middle,
                      double half_width, double gap, const RigidNode& robot,
                      const RigidNode& obstacle, double* motion_bound);

// Of two triangles.  They meet if an edge of one runs through the inside of the
// other, and would if each corner were 2 slack away, which is 8 times
// what rounding moves it: touching is unknown.  Where the bound is above
// `coarse`, a pair with a hint is asked along that alone, or along its distance
// too where that would not part it for about half as long: its halves follow.
PairSight LookAtTriangles(const FramedMotion& motion, const RigidPose& middle,
                          double half_width, double gap, double coarse,
                          const TriangleCorners& robot,
                          const TriangleCorners& obstacle, PairHint* hint,
                          double* motion_bound);

}  // namespace phongpd::internal
