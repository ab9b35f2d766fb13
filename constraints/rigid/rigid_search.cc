// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_search.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

void Tell(const RigidSides& sides, MotionVerdict outcome, const RigidPart& part,
          int triangle, int other, RigidCheck* check) {
  check->outcome = outcome;
  check->time = part.Middle();
  check->from = part.From();
  check->to = part.To();
  if (triangle >= 0) NameTriangles(sides, triangle, other, check);
}

}  // namespace

RigidCheck SearchAnyHit(const RigidSides& sides, const FramedMotion& motion,
                        long max_tests) {
  const double resolution = ResolutionOf(sides, motion);
  RigidDescent descent(sides.robot.tree, sides.obstacle.tree, motion);
  RigidCheck check;
  check.outcome = MotionVerdict::kFree;
  const auto tell = [&](MotionVerdict outcome, const RigidPart& part, int robot,
                        int obstacle) {
    Tell(sides, outcome, part, robot, obstacle, &check);
  };
  descent.Push({});
  while (!descent.IsDone()) {
    RigidPart part = descent.Pop();
    if (check.tests >= max_tests) {
      if (check.outcome == MotionVerdict::kFree) {
        tell(MotionVerdict::kUndecided, part, -1, -1);
      }
      break;
    }
    ++check.tests;
    double bound = 0.0;
    const PairSight sight = descent.Look(&part, 0.0, resolution, &bound);
    if (sight == PairSight::kApart) continue;
    const int robot = descent.RobotTriangle(part);
    const int obstacle = descent.ObstacleTriangle(part);
    if (sight == PairSight::kMeet) {
      tell(MotionVerdict::kCollides, part, robot, obstacle);
      return check;
    }
    if (bound > resolution && part.level < RigidDescent::kMaxHalvings) {
      descent.Halve(part);
    } else if (check.outcome == MotionVerdict::kFree) {
      tell(MotionVerdict::kUndecided, part, robot, obstacle);
      max_tests = std::min(max_tests, 2 * check.tests + kFurtherRigidTests);
    }
  }
  if (check.IsFree() && IsInsideAtStart(sides, motion)) {
    check.outcome = MotionVerdict::kCollides;
    check.time = check.from = check.to = 0.0;
  }
  return check;
}

bool IsInsideAtStart(const RigidSides& sides, const FramedMotion& motion) {
  const RigidPose start = motion.At(0.0);
  if (!sides.obstacle.solids.empty()) {
    for (const Vector3d& p : sides.robot.seeds) {
      if (sides.obstacle.Holds(start.rotation * p + start.position)) {
        return true;
      }
    }
  }
  if (sides.robot.solids.empty()) return false;
  for (const Vector3d& b : sides.obstacle.seeds) {
    const Vector3d p = start.rotation.transpose() * (b - start.position);
    if (p.norm() <= 2.0 * sides.robot.tree.reach && sides.robot.Holds(p)) {
      return true;
    }
  }
  return false;
}

}  // namespace phongpd::internal
