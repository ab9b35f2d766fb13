// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planners/rigid/object_norm.h"
#include "planners/rigid/pose_contacts.h"
#include "planners/rigid/rigid_links.h"
#include "planners/rigid/rigid_model.h"

namespace phongpd::internal {

// Where a slide pulls the robot.
struct SlidePull {
  RobotPose to;           // to a pose, all of it
  bool is_tow = false;    // or one point of the robot to a place,
  Eigen::Vector3d grip;   // this one, in the robot's frame,
  Eigen::Vector3d place;  // there; the rest follows
};

// Collide and slide for a robot that turns.  Straight to the first contact (not
// of a tow); then steps ξ = (v, L ω) of at most a twentieth of the reach R,
//
//   min |ξ − ξ*|²  subject to  n · v + (r × n) · ω ≥ −(gap − skin)        (1)
//
// for all pairs of triangles within 1.2 steps, ξ* the step the pull asks for;
// of a tow |G ξ − g|² + 0.02 |ξ|² is least, with G ξ the motion of the grip.
// `skin` is 5e-5 R: gaps stay about as large, those below are opened again.
// (1) is linear, the motion is not: each is judged, and cut at its contact.
//
// One slider per thread.
class RigidSlide {
 public:
  // `turns`: what is pulled may turn; else no pull asks it to, and ω is 0.
  RigidSlide(const RigidModel& model, bool turns, RigidLinks* links);

  // From a free pose; the path starts with it, every link is proved free, and
  // every pose is nearer to what is pulled to than the one before.  True: the
  // path ends in pull.to, bit for bit; of a tow: its grip is in place, to skin.
  bool Slide(const RobotPose& from, const SlidePull& pull,
             std::vector<RobotPose>* path);

  double skin() const { return skin_; }

 private:
  static constexpr int kMaxRows = 50;

  struct Step {
    Vector6 move = Vector6::Zero();
    bool arrived = false;
  };

  // Where a move goes.
  struct Aim {
    RobotPose pose;
    bool is_step = false;  // not so small that it is none
    bool is_last = false;  // the pose pulled to
    bool has_arrived = false;
  };

  double Rest(const RobotPose& pose, const SlidePull& pull) const;
  // Along (1) by a step of that length.
  Aim AimFrom(const RobotPose& pose, const SlidePull& pull, double step);
  // The best step of that length that (1) allows.
  Step BestStep(const RobotPose& pose, const SlidePull& pull, double length);
  // Rows of (1), nearest contacts first, in coordinates y with ξ = C⁻ᵀ y.
  void MakeRows(const Eigen::Matrix<double, 6, 6>& factor, double length,
                const RobotPose& pose);
  // Of (1) by projected Gauss–Seidel on the dual.
  Vector6 Project(const Vector6& wanted) const;

  const RigidModel& model_;
  const bool turns_;
  RigidLinks* links_;
  const double gyration_, skin_, max_step_;
  std::vector<PoseContact> contacts_;
  int rows_ = 0;
  std::array<Vector6, kMaxRows> directions_, raw_;
  std::array<double, kMaxRows> least_, squares_;
};

}  // namespace phongpd::internal
