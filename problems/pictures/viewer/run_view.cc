// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/pictures/viewer/run_view.h"

#include <algorithm>

namespace phongpd {
namespace {

// What people call what the planner grows.
std::string GrownBy(const std::string& planner) {
  if (planner == "retraction-rrt") return "retraction tree";
  if (planner == "retraction-forest") return "retraction trees";
  if (planner == "rrt-connect") return "the planner's trees";
  return "roadmap";
}

ViewGraph RoutesOf(const PlanResult& exact) {
  ViewGraph graph;
  graph.name = "routes compared";
  for (const std::vector<Eigen::Vector3d>& route : exact.routes) {
    const int first = static_cast<int>(graph.points.size());
    graph.points.insert(graph.points.end(), route.begin(), route.end());
    for (int k = 1; k < static_cast<int>(route.size()); ++k) {
      graph.edges.emplace_back(first + k - 1, first + k);
    }
  }
  return graph;
}

}  // namespace

ViewBehind BehindPlan(const PlanningStudy& study,
                      const PlanningResult& result) {
  ViewBehind behind;
  if (result.planner == kContactSurface) {
    // One route is the path itself.
    if (study.exact().routes.size() > 1) {
      behind.graph = RoutesOf(study.exact());
    }
  } else {
    behind.graph = {GrownBy(result.planner), result.numbers.graph.points,
                    result.numbers.graph.edges};
  }
  return behind;
}

ViewBehind BehindTrajectory(const TrajectoryStudy& study,
                            const PipelineResult& result) {
  ViewBehind behind;
  const bool has_corridor =
      std::any_of(result.stages.begin(), result.stages.end(),
                  [&](const StageRecord& stage) {
                    return stage.stage == "corridor" &&
                           stage.route == result.route && stage.is_free;
                  });
  if (!has_corridor || !HasFreePath(result.status)) return behind;
  for (const CorridorPlane& plane : study.Corridor(result.path)) {
    const auto k = static_cast<std::size_t>(plane.segment);
    behind.planes.push_back({plane.point, plane.normal,
                             (result.path[k + 1] - result.path[k]).norm()});
  }
  return behind;
}

}  // namespace phongpd
