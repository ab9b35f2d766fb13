// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/rigid_view.h"

#include <cmath>
#include <utility>

#include "constraints/rigid/rigid_motion.h"
#include "core/pi.h"

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
  constexpr double kTurn = 3.0 * kPi / 180.0;
  NamedPath path;
  path.name = std::move(name);
  path.is_free = is_free;
  const auto add = [&path](const RobotPose& pose) {
    path.points.push_back(pose.position);
    path.turns.push_back(pose.orientation);
  };
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const RigidMotion motion(poses[i], poses[i + 1]);
    const double steps = std::ceil(std::max(1.0, motion.angle() / kTurn));
    for (double k = 0.0; k < steps; ++k) add(motion.At(k / steps));
  }
  if (!poses.empty()) add(poses.back());
  return path;
}

}  // namespace phongpd
