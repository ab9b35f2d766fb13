// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/exact_pair.h"
#include "constraints/rigid/rigid_search.h"

namespace phongpd::internal {
namespace {

// Of half the robot's diagonal: a pair that is not told apart while it moves by
// so much is decided exactly, which is dear, but ends there.  By (2) of
// rigid_pair.h only pairs about the square of it apart come to that.
constexpr double kExactShare = 1e-2;

void Tell(const RigidSides& sides, MotionVerdict outcome, const RigidPart& part,
          double time, RigidCheck* check) {
  check->outcome = outcome;
  check->time = time;
  check->from = part.From();
  check->to = part.To();
  const RigidNode& a =
      sides.robot.tree.nodes[static_cast<std::size_t>(part.robot)];
  const RigidNode& b =
      sides.obstacle.tree.nodes[static_cast<std::size_t>(part.obstacle)];
  if (a.IsLeaf() && b.IsLeaf()) {
    NameTriangles(sides, a.triangle, b.triangle, check);
  }
}

}  // namespace

RigidCheck SearchExactly(const RigidSides& sides, const FramedMotion& motion,
                         const QuaternionMotion& given, long max_tests) {
  const double resolution = std::max(ResolutionOf(sides, motion),
                                     kExactShare * sides.robot.tree.size);
  const ExactPairJudge exact(given);
  RigidDescent descent(sides.robot.tree, sides.obstacle.tree, motion);
  RigidCheck check;
  check.outcome = MotionVerdict::kFree;
  descent.Push({});
  while (!descent.IsDone()) {
    RigidPart part = descent.Pop();
    if (check.tests >= max_tests) {
      if (check.IsFree()) {
        Tell(sides, MotionVerdict::kUndecided, part, part.Middle(), &check);
      }
      return check;
    }
    ++check.tests;
    double bound = 0.0;
    const PairSight sight = descent.Look(&part, 0.0, resolution, &bound);
    if (sight == PairSight::kApart) continue;
    if (sight == PairSight::kMeet) {
      Tell(sides, MotionVerdict::kCollides, part, part.Middle(), &check);
      return check;
    }
    if (bound > resolution && part.level < RigidDescent::kMaxHalvings) {
      descent.Halve(part);
      continue;
    }
    double time = part.Middle();
    bool is_decided = false;
    const bool meets = exact.Meet(
        sides.robot
            .given[static_cast<std::size_t>(descent.RobotTriangle(part))],
        sides.obstacle
            .given[static_cast<std::size_t>(descent.ObstacleTriangle(part))],
        part.From(), part.To(), &time, &is_decided);
    if (meets) {
      Tell(sides, MotionVerdict::kCollides, part, time, &check);
      return check;
    }
    if (!is_decided && check.IsFree()) {
      Tell(sides, MotionVerdict::kUndecided, part, part.Middle(), &check);
    }
  }
  if (check.IsFree() && IsInsideAtStart(sides, motion)) {
    check.outcome = MotionVerdict::kCollides;
    check.time = check.from = check.to = 0.0;
  }
  return check;
}

}  // namespace phongpd::internal
