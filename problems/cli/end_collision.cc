// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/end_collision.h"

#include "constraints/rigid/rigid_judge.h"

namespace phongpd::cli {

std::string CollidingEnd(PathStatus status) {
  return status == PathStatus::kStartInCollision  ? "start"
         : status == PathStatus::kGoalInCollision ? "goal"
                                                  : "";
}

std::string TrianglesThatMeet(const Workspace& workspace,
                              const Eigen::Vector3d& q) {
  std::vector<TriangleMesh> obstacles;
  for (const Solid& obstacle : workspace.obstacles) {
    obstacles.push_back(obstacle.mesh());
  }
  RobotPose pose;
  pose.position = q;
  const RigidCheck check = RigidJudge({workspace.robot.mesh()}, obstacles)
                               .Check(RigidMotion(pose, pose));
  if (check.outcome != MotionVerdict::kCollides || check.robot_triangle < 0) {
    return "";
  }
  const auto mesh = static_cast<std::size_t>(check.obstacle_mesh);
  return "triangle " + std::to_string(check.robot_triangle) +
         " of the robot meets triangle " +
         std::to_string(check.obstacle_triangle) + " of " +
         workspace.obstacles[mesh].name();
}

}  // namespace phongpd::cli
