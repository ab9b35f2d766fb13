// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/scene_view.h"

#include <utility>

#include "planners/world/workspace.h"
#include "viewer/motion_view.h"

namespace phongpd {

View SceneView(const Scene& scene,
               const std::vector<TriangleMesh>& contact_spaces) {
  View view;
  view.title = scene.name;
  if (!scene.workspace.unit.empty()) view.unit = scene.workspace.unit;
  view.notes = scene.warnings;
  view.robot = scene.workspace.robot;
  view.start = scene.start;
  view.goal = scene.goal;
  view.bounds = scene.workspace.bounds;
  for (const Solid& obstacle : scene.workspace.obstacles) {
    view.meshes.push_back(
        {obstacle.name(), ViewRole::kObstacle, obstacle.mesh()});
  }
  for (const TriangleMesh& mesh : contact_spaces) {
    view.meshes.push_back({"contact space", ViewRole::kContactSpace, mesh});
  }
  view.movers = MoversOf(scene.moving, 0.0);
  view.length = ContactBounds(scene.workspace).Diagonal();
  if (scene.planning.clearance) {
    view.wanted_clearance = scene.planning.clearance->Resolve(view.length).unit;
  }
  return view;
}

View FleetSceneView(const FleetScene& scene) {
  View view = SceneView(scene.robots.front());
  view.robot = {};
  view.start.reset();
  view.goal.reset();
  for (const Scene& robot : scene.robots) {
    NamedPath path = {robot.workspace.robot.name(), {robot.start}};
    path.robot = robot.workspace.robot;
    view.ends.push_back({path.name, robot.start, robot.goal});
    view.paths.push_back(std::move(path));
  }
  return view;
}

View ExploredView(const Scene& scene, const TriangleMesh& explored) {
  View view = SceneView(scene);
  view.meshes.push_back({kExploredName, ViewRole::kContactSpace, explored});
  return view;
}

View WindowView(const Scene& scene, const World& world) {
  View view = SceneView(scene);
  for (const ConvolutionModel& model : world.Convolution().models) {
    view.meshes.push_back(
        {kConvolutionName, ViewRole::kContactSpace, model.Mesh()});
  }
  return view;
}

}  // namespace phongpd
