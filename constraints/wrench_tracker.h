// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"

namespace phongpd {

// The answer at one pose.  Lengths in the user's unit.
struct TrackedWrench {
  // kPenetrating, kTouching or kSeparate, exact.  kInvalid: the pose is not
  // finite; all other members are zero, and the state does not change.
  DepthStatus status = DepthStatus::kInvalid;
  // All members below are zero unless penetrating.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // n, unit
  // r: from the robot's origin q to where the wrench acts, in the obstacle's
  // frame.
  Eigen::Vector3d lever = Eigen::Vector3d::Zero();
  // s > 0, the shortest way out along n: moved by s·n the robot touches from
  // outside, and by less than that it does not.
  double exit = 0.0;
  double push = 0.0;  // ŝ: follows s at a bounded speed; scale forces by it
  double euclidean_depth = 0.0;  // the least s of all directions
  double turned = 0.0;  // the angle n turned by since the last step, radians
  double wanted = 0.0;  // the angle it would have turned by without the bound
  // n is the Euclidean direction, because there was no smoothed one (happens in
  // SmoothedAt only).
  bool is_fallback = false;

  Eigen::Vector3d Torque() const { return lever.cross(normal); }  // r × n
};

// Where to push a penetrating robot out, and with what torque: a wrench
// (n, r × n) along a motion of poses that changes at a bounded speed, for
// simulation and haptics.  Let δ = √(|Δq|² + (Lθ)²) be the length of a step,
// with θ the angle the robot turns by, and L the radius of gyration of its
// surface about its origin.  From one penetrating step to the next, to
// rounding and whatever the shapes,
//
//   ∠(n, n') ≤ κ δ/L,    |Δr| ≤ κ δ,    |Δŝ| ≤ κ δ      (1)
//
// with r in the robot's own frame.  In each step n, r and ŝ go half way to a
// goal, but not farther than (1) allows.  The goals are:
//
//   n   the gradient of smoothed occupancy (smoothed_normal.h) of C_cont at
//       q + s·n, with ρ = max(s/2, L/20); the Euclidean direction if s is more
//       than 1.5 times the Euclidean depth
//   r   GapLever's mean (gap_lever.h) for the robot moved by s·n, with a reach
//       of an eighth of the robot's diagonal
//   ŝ   s
//
// The first step inside starts at the Euclidean direction, the exit s along it,
// and the mean there.
//
// The exit s itself has no bound, and no tracker can have one: where free space
// closes as the robot turns (a peg in a tight hole), the least depth itself
// jumps.  So s·n can jump in its length, but not in its direction.  Every s
// separates the solids all the same.
//
// It is a state along a motion, not a field: two motions to the same pose may
// give different wrenches, n is not the gradient of a depth, and the work of a
// force ŝ·n around a closed motion need not vanish.  For solvers use PoseRow or
// TrackedPoseRow.
//
// Each step builds a contact space: milliseconds for small meshes.  Steps at
// the same orientation can share it (the second Step).
class WrenchTracker {
 public:
  // Where a motion is.  A value: a copy is a motion of its own.
  struct State {
    bool has_begun = false;  // the last step was penetrating
    RobotPose pose;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d lever = Eigen::Vector3d::Zero();  // robot's own frame
    double push = 0.0;
  };

  // `speed` is κ of (1), without unit.  The smaller it is, the longer are the
  // exits (results/rigid-depth compares 2 with no bound).  Throws InputError
  // unless it is finite and > 0.
  static constexpr double kSpeed = 2.0;
  WrenchTracker(const Solid& robot, const Solid& obstacle,
                double speed = kSpeed);

  // C_cont of the robot turned by `orientation`.  Throws InputError unless this
  // has length 1, to 1e-9, and what BuildContactSpace throws.
  ContactSpace SpaceAt(const Eigen::Quaterniond& orientation) const;

  // The wrench at `pose`, the next one of the motion that *state belongs to.
  // Throws like SpaceAt.
  TrackedWrench Step(const RobotPose& pose, State* state) const;
  // The same with `space` = SpaceAt(pose.orientation), built before.
  TrackedWrench Step(const ContactSpace& space, const RobotPose& pose,
                     State* state) const;

  // A wrench that depends on this pose alone; `turned` and `wanted` are zero.
  // n is SmoothedMetric's direction at q with its default length, or the
  // Euclidean one where that is not known (`is_fallback`); r is GapLever's mean
  // for the robot where it lies; s is the exit along n; ŝ is the Euclidean
  // depth.  Continuous in the pose wherever the smoothed direction is known and
  // the depths themselves do not jump.  Its exits are longer than Step's.
  TrackedWrench SmoothedAt(const ContactSpace& space,
                           const RobotPose& pose) const;

  double gyration() const;  // L
  // δ of the shorter turn from a to b, user's unit.
  double StepLength(const RobotPose& a, const RobotPose& b) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace phongpd
