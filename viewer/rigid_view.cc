// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/rigid_view.h"

#include <utility>

#include "viewer/drawn_poses.h"

namespace phongpd {

View TurningSceneView(const TurningScene& scene) {
  View view;
  view.title = scene.name;
  if (!scene.unit.empty()) view.unit = scene.unit;
  view.notes = scene.warnings;
  for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
    view.meshes.push_back({obstacle.name, ViewRole::kObstacle, obstacle.mesh});
  }
  view.robot = scene.robot;
  view.start = scene.start.position;
  view.goal = scene.goal.position;
  view.start_turn = scene.start.orientation;
  view.goal_turn = scene.goal.orientation;
  view.turns = true;
  view.bounds = scene.bounds;
  return view;
}

NamedPath RigidPath(std::string name, const std::vector<RobotPose>& poses,
                    bool is_free) {
  NamedPath path;
  path.name = std::move(name);
  path.is_free = is_free;
  for (const RobotPose& pose : DrawnPoses(poses)) {
    path.points.push_back(pose.position);
    path.turns.push_back(pose.orientation);
  }
  return path;
}

}  // namespace phongpd
