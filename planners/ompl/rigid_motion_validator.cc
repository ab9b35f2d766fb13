// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/rigid_motion_validator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;

// Of the product of two unit quaternions, the cosine of half the turn: 1e-9 rad
// from half a turn.
constexpr double kHalfTurn = 0.5e-9;
// As RobotPose's (CheckPose) and OMPL's own.
constexpr double kUnitTo = 1e-9;
constexpr double kLastValidTo = 1.0 / 256.0;

bool IsPose(const RobotPose& pose) {
  return IsFinite(pose.position) &&
         std::abs(pose.orientation.norm() - 1.0) <= kUnitTo;
}

void RequirePoses(const char* what, const ob::StateSpace& space) {
  if (dynamic_cast<const ob::SE3StateSpace*>(&space) != nullptr) return;
  throw InputError(std::string(what) + ": expected an SE3StateSpace, found '" +
                   space.getName() + "'; MakePoseSpace makes one");
}

}  // namespace

std::shared_ptr<ob::SE3StateSpace> MakePoseSpace(const BoundingBox& region) {
  if (!IsFinite(region.min) || !IsFinite(region.max) ||
      !(region.min.array() < region.max.array()).all()) {
    throw InputError(
        "pose space: expected a region with finite min < max on every axis, "
        "found none; give the bounds of the robot's origin");
  }
  auto space = std::make_shared<ob::SE3StateSpace>();
  ob::RealVectorBounds bounds(3);
  for (unsigned int k = 0; k < 3; ++k) {
    bounds.setLow(k, region.min[k]);
    bounds.setHigh(k, region.max[k]);
  }
  space->setBounds(bounds);
  return space;
}

ob::SpaceInformationPtr MakeRigidSpaceInformation(const RigidJudge& judge,
                                                  const BoundingBox& region) {
  auto si = std::make_shared<ob::SpaceInformation>(MakePoseSpace(region));
  si->setStateValidityChecker(
      std::make_shared<RigidValidityChecker>(si, judge));
  si->setMotionValidator(std::make_shared<RigidMotionValidator>(si, judge));
  si->setup();
  return si;
}

RobotPose ToRobotPose(const ob::State* state) {
  const auto* pose = state->as<ob::SE3StateSpace::StateType>();
  const ob::SO3StateSpace::StateType& r = pose->rotation();
  RobotPose result;
  result.position = {pose->getX(), pose->getY(), pose->getZ()};
  result.orientation = Eigen::Quaterniond(r.w, r.x, r.y, r.z);
  return result;
}

void FromRobotPose(const RobotPose& pose, ob::State* state) {
  auto* result = state->as<ob::SE3StateSpace::StateType>();
  result->setXYZ(pose.position.x(), pose.position.y(), pose.position.z());
  ob::SO3StateSpace::StateType& r = result->rotation();
  r.w = pose.orientation.w();
  r.x = pose.orientation.x();
  r.y = pose.orientation.y();
  r.z = pose.orientation.z();
}

RigidValidityChecker::RigidValidityChecker(const ob::SpaceInformationPtr& si,
                                           RigidJudge judge)
    : StateValidityChecker(si), judge_(std::move(judge)) {
  RequirePoses("rigid validity checker", *si->getStateSpace());
}

bool RigidValidityChecker::isValid(const ob::State* state) const {
  checks_.fetch_add(1, std::memory_order_relaxed);
  const RobotPose pose = ToRobotPose(state);
  if (!IsPose(pose) || !si_->satisfiesBounds(state)) return false;
  const RigidCheck check = judge_.Check(RigidMotion(pose, pose));
  if (check.outcome == MotionVerdict::kUndecided) {
    undecided_.fetch_add(1, std::memory_order_relaxed);
  }
  return check.IsFree();
}

RigidMotionValidator::RigidMotionValidator(const ob::SpaceInformationPtr& si,
                                           RigidJudge judge)
    : MotionValidator(si), judge_(std::move(judge)) {
  RequirePoses("rigid motion validator", *si->getStateSpace());
}

// What is no motion to be judged collides from the beginning.
RigidCheck RigidMotionValidator::Judge(const RobotPose& start,
                                       const RobotPose& end) const {
  RigidCheck refused;
  refused.outcome = MotionVerdict::kCollides;
  if (!IsPose(start) || !IsPose(end)) return refused;
  if (std::abs(start.orientation.dot(end.orientation)) <= kHalfTurn) {
    half_turns_.fetch_add(1, std::memory_order_relaxed);
    return refused;
  }
  RigidCheck check = judge_.Check(RigidMotion(start, end));
  if (check.outcome == MotionVerdict::kUndecided) {
    undecided_.fetch_add(1, std::memory_order_relaxed);
  }
  return check;
}

// OMPL's counters are plain integers that other threads update too.
bool RigidMotionValidator::Count(bool is_free) const {
  __atomic_fetch_add(is_free ? &valid_ : &invalid_, 1u, __ATOMIC_RELAXED);
  return is_free;
}

bool RigidMotionValidator::checkMotion(const ob::State* s1,
                                       const ob::State* s2) const {
  return Count(Judge(ToRobotPose(s1), ToRobotPose(s2)).IsFree());
}

bool RigidMotionValidator::checkMotion(
    const ob::State* s1, const ob::State* s2,
    std::pair<ob::State*, double>& lastValid) const {
  // Copies: s1 and s2 may be what is written to.
  const RobotPose start = ToRobotPose(s1), end = ToRobotPose(s2);
  const RigidCheck whole = Judge(start, end);
  if (Count(whole.IsFree())) return true;
  RobotPose last = start;
  double low = 0.0, high = whole.time;
  if (high > 0.0) {
    const RigidMotion motion(start, end);
    // What is judged is the motion to the very pose that is written.
    while (high - low > kLastValidTo) {
      const double middle = 0.5 * (low + high);
      const RobotPose pose = motion.At(middle);
      const RigidCheck check = judge_.Check(RigidMotion(start, pose));
      if (check.IsFree()) {
        low = middle;
        last = pose;
      } else {
        high = std::min(middle, middle * check.time);
      }
    }
  }
  lastValid.second = low;
  if (lastValid.first != nullptr) FromRobotPose(last, lastValid.first);
  return false;
}

}  // namespace phongpd
