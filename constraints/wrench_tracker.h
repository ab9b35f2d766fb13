// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"

namespace phongpd {

// Answer to one pose.  Lengths in the user's unit.
struct TrackedWrench {
  // kPenetrating, kTouching, kSeparate, exact; kInvalid: the pose is not
  // finite, all other members are zero and the state is as it was.
  DepthStatus status = DepthStatus::kInvalid;
  // All below is zero unless penetrating.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // n, unit
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();  // r from q, not turned back
  // s > 0: moved by s·n the robot touches from outside, and by no less along n.
  double exit = 0.0;
  double push = 0.0;             // ŝ: follows s at a bounded speed; for forces
  double euclidean_depth = 0.0;  // the least s of all directions
  double turned = 0.0;  // by how much n did since the last step, radians
  double wanted = 0.0;  // what it would have turned without a bound
  // n is Euclid's, for want of a smoothed one (SmoothedAt alone).
  bool is_fallback = false;

  Eigen::Vector3d Torque() const { return lever.cross(normal); }  // r × n
};

// A wrench (n, r × n) along a motion of poses, with a bound on how fast it
// changes.  With δ² = |Δq|² + (Lθ)² the length of a step (L the radius of
// gyration of the robot's surface about its origin, θ the angle it turns by),
// from one penetrating step to the next
//
//   ∠(n, n') ≤ κ δ/L,    |Δr| ≤ κ δ,    |Δŝ| ≤ κ δ      (1)
//
// to rounding, whatever the shapes, r in the robot's own frame: n turns towards
// what it wants, half of the way, by at most that.  It wants the gradient of
// smoothed occupancy (smoothed_normal.h) of C_cont at q + s·n, with ρ half the
// way out s but at least L/20; and Euclid's direction where s is more than 1.5
// times Euclid's depth.  r makes for GapLever's mean, with the reach of an
// eighth of the robot's diagonal, of the robot moved by s·n, ŝ for s, both half
// of the way a step.  The first step inside begins with Euclid's direction,
// the way out along it and the mean as they are.
//
// What has no bound, and no tracker can have one, is the way out: where a free
// place closes as the robot turns (a peg in a tight hole) the least depth
// itself jumps.  So s·n does not jump by n, but by s; every s frees all the
// same.
//
// It is a state along a motion, not a field: two motions to the same pose may
// have different wrenches, n is no gradient of a depth, and the work of a force
// ŝ·n around a closed motion need not vanish.  For solvers: PoseRow.
//
// Costs a contact space a step, milliseconds for small meshes; many steps at
// one orientation share it (the second Step).
class WrenchTracker {
 public:
  // Where a motion is: a value, copies go their own ways.
  struct State {
    bool has_begun = false;  // the last step was inside
    RobotPose pose;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d lever = Eigen::Vector3d::Zero();  // robot's own frame
    double push = 0.0;
  };

  // κ: how fast the direction turns, the lever moves and the push grows at
  // most, in lengths of the robot's own step.  The less, the longer the ways
  // out (results/rigid-depth: 2 beside none).  Throws InputError unless it is
  // finite and above 0.
  static constexpr double kSpeed = 2.0;
  WrenchTracker(const Solid& robot, const Solid& obstacle,
                double speed = kSpeed);

  // C_cont of the robot turned by a quaternion of unit length, to 1e-9 (throws
  // InputError otherwise, and as BuildContactSpace).
  ContactSpace SpaceAt(const Eigen::Quaterniond& orientation) const;

  // The wrench at the next pose of the motion that *state is of.  Throws as
  // SpaceAt.
  TrackedWrench Step(const RobotPose& pose, State* state) const;
  // The same with the space of the pose's orientation.
  TrackedWrench Step(const ContactSpace& space, const RobotPose& pose,
                     State* state) const;

  // The smoothed wrench: of this pose alone, nothing is remembered, `turned`
  // and `wanted` are zero.  n is SmoothedMetric's direction at q with its
  // default length (Euclid's where that is not known, `is_fallback`), r
  // GapLever's mean of the robot as it lies, s the way out along n, ŝ Euclid's
  // depth.  Continuous in the pose wherever that direction is known, but for
  // depths that jump themselves; s is longer than the tracker's.
  TrackedWrench SmoothedAt(const ContactSpace& space,
                           const RobotPose& pose) const;

  double gyration() const;  // L
  // δ, of the shorter turn.
  double StepLength(const RobotPose& a, const RobotPose& b) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace phongpd
