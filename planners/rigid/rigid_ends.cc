// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_ends.h"

#include <string>

#include "core/number_text.h"
#include "planners/rigid/end_depth.h"

namespace phongpd::internal {
namespace {

std::string WhoMeets(const RigidWorld& world, const RigidCheck& check) {
  const auto name = [](const char* side, std::size_t meshes, int mesh,
                       int triangle) {
    std::string text = "triangle " + std::to_string(triangle) + " of the ";
    text += side;
    if (meshes > 1) text += ", mesh " + std::to_string(mesh);
    return text;
  };
  if (check.robot_triangle < 0) {
    return check.outcome == MotionVerdict::kCollides
               ? "one holds a part of the other"
               : "nothing was looked at";
  }
  return name("robot", world.robot().size(), check.robot_mesh,
              check.robot_triangle) +
         (check.outcome == MotionVerdict::kCollides
              ? " meets "
              : " is not told apart from ") +
         name("obstacles", world.obstacles().size(), check.obstacle_mesh,
              check.obstacle_triangle);
}

bool IsEndFree(const RigidWorld& world, const TreeTask& task,
               const RobotPose& pose, const std::string& name,
               PathStatus in_collision, PathStatus out_of_bounds,
               RigidAnswer* answer) {
  const RigidCheck check = world.judge().Check(RigidMotion(pose, pose));
  ++answer->checks;
  answer->tests += check.tests;
  if (!check.IsFree()) {
    answer->status = in_collision;
    answer->collision = check;
    answer->reason = "the " + name + " is not free: " + WhoMeets(world, check);
    answer->depth = DepthAtEnd(world, check, pose);
    if (answer->depth) {
      answer->reason += ", " + Rounded(*answer->depth) + " deep";
    }
    return false;
  }
  if (!task.bounds.contains(pose.position)) {
    answer->status = out_of_bounds;
    answer->reason = "the " + name + " is out of bounds: expected within " +
                     FormatPoint(task.bounds.min()) + " and " +
                     FormatPoint(task.bounds.max()) + ", found " +
                     FormatPoint(pose.position);
    return false;
  }
  return true;
}

}  // namespace

Eigen::AlignedBox3d BoundsOf(const RigidWorld& world,
                             const RigidRequest& request) {
  if (!request.bounds.isEmpty()) return request.bounds;
  Eigen::AlignedBox3d box = world.obstacle_box();
  box.extend(request.start.position);
  box.extend(request.goal.position);
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(2.0 * world.reach());
  return {box.min() - around, box.max() + around};
}

bool AreEndsFree(const RigidWorld& world, const TreeTask& task,
                 RigidAnswer* answer) {
  return IsEndFree(world, task, task.start, "start",
                   PathStatus::kStartInCollision, PathStatus::kStartOutOfBounds,
                   answer) &&
         IsEndFree(world, task, task.goal, "goal", PathStatus::kGoalInCollision,
                   PathStatus::kGoalOutOfBounds, answer);
}

bool ConfirmPath(const RigidWorld& world, const Eigen::AlignedBox3d& bounds,
                 RigidAnswer* answer) {
  // Of each motion; some tenths of a second at most.
  constexpr long kMaxClearanceTests = 1'000'000;
  for (RobotPose& pose : answer->path) {
    pose.position = pose.position.cwiseMax(bounds.min()).cwiseMin(bounds.max());
  }
  answer->length = 0.0;
  for (std::size_t i = 0; i + 1 < answer->path.size(); ++i) {
    const RobotPose& from = answer->path[i];
    const RobotPose& to = answer->path[i + 1];
    const RigidCheck check = world.judge().Check(RigidMotion(from, to));
    ++answer->checks;
    answer->tests += check.tests;
    if (check.IsFree()) {
      answer->length += world.Distance(from, to);
      continue;
    }
    answer->status = PathStatus::kNotCertified;
    answer->reason = "motion " + std::to_string(i) + " of the path is " +
                     ToString(check.outcome) + " by the judge's second pass";
    answer->path.clear();
    answer->length = 0.0;
    return false;
  }
  answer->clearance =
      world.judge().PathClearance(answer->path, {}, kMaxClearanceTests);
  answer->tests += answer->clearance.tests;
  return true;
}

}  // namespace phongpd::internal
