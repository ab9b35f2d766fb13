// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ompl/base/MotionValidator.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "constraints/rigid/rigid_judge.h"
#include "core/mesh/triangle_mesh.h"

// Free space for OMPL's planners of a robot that translates and turns: a state
// of an SE3StateSpace is a pose, and RigidJudge proves motions free instead of
// testing samples.  Use MakeRigidSpaceInformation, then any of OMPL's geometric
// planners: every motion of its path is proved free for all t.
namespace phongpd {

// The state space of poses with a position in the region and any orientation.
// Throws InputError unless the region is finite with min < max on every axis.
std::shared_ptr<ompl::base::SE3StateSpace> MakePoseSpace(
    const BoundingBox& region);

// That state space with both classes below, set up and ready for a planner.
ompl::base::SpaceInformationPtr MakeRigidSpaceInformation(
    const RigidJudge& judge, const BoundingBox& region);

// `state` must be a state of an SE3StateSpace.
RobotPose ToRobotPose(const ompl::base::State* state);
void FromRobotPose(const RobotPose& pose, ompl::base::State* state);

// Is the pose proved free and within the space's bounds?  False if it is
// undecided (rigid_judge.h) or not finite.  Thread-safe.
class RigidValidityChecker : public ompl::base::StateValidityChecker {
 public:
  // Throws InputError unless the space is an SE3StateSpace.
  RigidValidityChecker(const ompl::base::SpaceInformationPtr& si,
                       RigidJudge judge);

  bool isValid(const ompl::base::State* state) const override;

  std::uint64_t checks() const { return checks_; }
  std::uint64_t undecided() const { return undecided_; }  // of the checks

 private:
  RigidJudge judge_;
  mutable std::atomic<std::uint64_t> checks_{0}, undecided_{0};
};

// Is the whole motion proved free?  An undecided motion is not valid, and is
// counted.  The bounds are convex, so that only the end states are tested
// against them (isValid).  Thread-safe.
//
// SE3StateSpace interpolates like RigidMotion: positions linearly, orientations
// by slerp, the shorter way.  There are two differences:
//
// - Within 1e-9 rad of half a turn both ways are equally long, and rounding
//   decides which one is taken.  Such a motion is not valid, and is counted in
//   half_turns().
// - OMPL's slerp ignores turns below 9e-5 rad.  The motion that is judged does
//   turn from one orientation to the other.
class RigidMotionValidator : public ompl::base::MotionValidator {
 public:
  // Throws InputError unless the space is an SE3StateSpace.
  RigidMotionValidator(const ompl::base::SpaceInformationPtr& si,
                       RigidJudge judge);

  bool checkMotion(const ompl::base::State* s1,
                   const ompl::base::State* s2) const override;

  // If the motion is not valid, lastValid.second is a fraction of it such that
  // the motion from s1 to the state there, which is written to lastValid.first,
  // is proved free.  Bisection finds it to 1/256 of the motion or better; 0 and
  // s1 if there is none.
  bool checkMotion(
      const ompl::base::State* s1, const ompl::base::State* s2,
      std::pair<ompl::base::State*, double>& lastValid) const override;

  std::uint64_t undecided() const { return undecided_; }
  std::uint64_t half_turns() const { return half_turns_; }

 private:
  RigidCheck Judge(const RobotPose& start, const RobotPose& end) const;
  bool Count(bool is_free) const;

  RigidJudge judge_;
  mutable std::atomic<std::uint64_t> undecided_{0}, half_turns_{0};
};

}  // namespace phongpd
