// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/view_windows.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "problems/cli/command.h"
#include "problems/scenes/scene_requests.h"
#include "viewer/run_view.h"
#include "viewer/scene_view.h"

namespace phongpd::cli {

ExploringRun ExploringRunOf(const nlohmann::json& row) {
  return {row.at("preset"), row.at("routes"),
          row.at("lengths").at("wanted_clearance").at("unit")};
}

void ShowExplored(const Scene& scene, const ExploringRun& of,
                  const ContactSpaceCache& cache, View* view) {
  Progress("exploring free space");
  PlanRequest request = PlanRequestOf(scene);
  request.planner = PlannerId::kContactSurface;
  request.model = Model::kWindow;
  request.preset = ParsePreset(of.preset, "preset");
  request.clearance = Length::FromUnit(of.clearance);
  request.routes = of.routes;
  request.verifies = false;  // it was
  const World world(scene.workspace, scene.name, cache);
  const PathAnswer answer = Plan(world, request);
  const BoundingBox region = PlanningRegion(world, request);
  if (answer.evidence.surface) {
    view->meshes.push_back({kExploredName, ViewRole::kContactSpace,
                            VisibleMesh(*answer.evidence.surface, region)});
  }
  for (NamedPath& path : view->paths) path.behind.window = region;
}

void ShowModel(const Scene& scene, const ContactSpaceCache& cache,
               bool is_window, View* view) {
  Progress(is_window ? "building the model of free space"
                     : "building the contact space");
  const World world(scene.workspace, scene.name, cache);
  View built =
      is_window ? WindowView(scene, world)
                : SceneView(scene, world.Spaces(SpaceLayout::kMerged).Meshes());
  for (ViewMesh& mesh : built.meshes) {
    if (mesh.role != ViewRole::kContactSpace) continue;
    view->meshes.push_back(std::move(mesh));
  }
  if (!is_window) return;
  const BoundingBox region = WindowRegion(world, scene.start, scene.goal);
  for (NamedPath& path : view->paths) path.behind.window = region;
}

void TellOfDepthWindows(bool is_table, View* view) {
  if (is_table) {
    view->notes.push_back(
        "Tables do not hold the windows that were built for their depths; "
        "answers with --json do.");
    return;
  }
  bool has_depths = false, has_windows = false;
  for (const ViewAnswer& answer : view->answers) {
    has_depths |= answer.is_depth;
    has_windows |= !answer.window_reaches.empty();
  }
  if (has_depths && !has_windows) {
    view->notes.push_back("No windows were built for these depths.");
  }
}

}  // namespace phongpd::cli
