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

// OMPL's view of a robot that moves and turns: states of an SE3StateSpace are
// poses, and RigidJudge decides without a resolution.  Any of OMPL's geometric
// planners takes it; every motion of its path is then proved free for all t.
namespace phongpd {

// The poses with positions within the region, any orientation.  Throws
// InputError unless the region is finite and min < max on every axis.
std::shared_ptr<ompl::base::SE3StateSpace> MakePoseSpace(
    const BoundingBox& region);

// That space with both classes below, set up.
ompl::base::SpaceInformationPtr MakeRigidSpaceInformation(
    const RigidJudge& judge, const BoundingBox& region);

// `state` is one of an SE3StateSpace.
RobotPose ToRobotPose(const ompl::base::State* state);
void FromRobotPose(const RobotPose& pose, ompl::base::State* state);

// Is the pose proved free?  Not where it is undecided, nor outside of the
// space's bounds, nor where it is not finite.  Thread-safe.
class RigidValidityChecker : public ompl::base::StateValidityChecker {
 public:
  // Throws InputError unless the space is an SE3StateSpace.
  RigidValidityChecker(const ompl::base::SpaceInformationPtr& si,
                       RigidJudge judge);

  bool isValid(const ompl::base::State* state) const override;

  std::uint64_t checks() const { return checks_; }
  std::uint64_t undecided() const { return undecided_; }  // of these

 private:
  RigidJudge judge_;
  mutable std::atomic<std::uint64_t> checks_{0}, undecided_{0};
};

// Is the whole motion proved free?  SE3StateSpace interpolates as RigidMotion
// does, positions linearly and orientations by slerp, the shorter way.  Two
// differences:
//
// - Within 1e-9 rad of half a turn both ways are as long, and which of them is
//   taken hangs on rounding: such a motion is not valid, and counted apart.
// - Turns below 9e-5 rad OMPL's slerp takes for none and leaves out; what is
//   judged turns from one orientation to the other.
//
// What is undecided is not valid, and counted.  Bounds are convex and the
// states' matter (isValid).  Thread-safe.
class RigidMotionValidator : public ompl::base::MotionValidator {
 public:
  // Throws InputError unless the space is an SE3StateSpace.
  RigidMotionValidator(const ompl::base::SpaceInformationPtr& si,
                       RigidJudge judge);

  bool checkMotion(const ompl::base::State* s1,
                   const ompl::base::State* s2) const override;

  // If not valid, lastValid.second is a fraction, found by bisection to 1/256
  // of the way or better, such that the motion from s1 to the state then
  // written to lastValid.first is proved free; 0 and s1 if there is none.
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
