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

bool WasPolished(const PipelineResult& result) {
  return HasFreePath(result.status) &&
         std::any_of(result.stages.begin(), result.stages.end(),
                     [&](const StageRecord& stage) {
                       return stage.stage == "corridor" &&
                              stage.route == result.route && stage.is_free;
                     });
}

std::vector<ViewPlane> CorridorAround(const TrajectoryStudy& study,
                                      const Path& path) {
  std::vector<ViewPlane> planes;
  for (const CorridorPlane& plane : study.Corridor(path)) {
    const auto k = static_cast<std::size_t>(plane.segment);
    planes.push_back(
        {plane.point, plane.normal, (path[k + 1] - path[k]).norm()});
  }
  return planes;
}

// "Ipopt from the line", "corridor, round 2".
std::string SpokenStage(const PathIterate& iterate,
                        const PipelineResult& result) {
  const bool is_corridor = iterate.stage == "corridor";
  std::string text = is_corridor ? "corridor" : "Ipopt";
  for (const StageRecord& stage : result.stages) {
    if (is_corridor || stage.stage != "start") continue;
    if (stage.route != iterate.route) continue;
    text += stage.status == "straight" ? " from the line"
                                       : " from the repaired start";
  }
  if (is_corridor || iterate.round > 0) {
    text += ", round " + std::to_string(iterate.round + 1);
  }
  return text;
}

ViewIterates IteratesOf(const TrajectoryStudy& study,
                        const PipelineResult& result,
                        const PathHistory& history) {
  ViewIterates iterates;
  iterates.count = history.count();
  for (const PathHistory::Entry& entry : history.Kept()) {
    const PathIterate& iterate = entry.iterate;
    iterates.kept.push_back({entry.number, SpokenStage(iterate, result),
                             iterate.record.is_restoration,
                             CheckPath(study.judge(), iterate.path).free,
                             study.Energy(iterate.path),
                             iterate.record.violation, iterate.path});
  }
  return iterates;
}

}  // namespace

ViewBehind BehindPlan(PlanningStudy* study, const PlanningResult& result) {
  ViewBehind behind;
  if (result.model == "window") behind.window = study->Region();
  if (result.planner == kContactSurface) {
    // One route is the path itself.
    if (study->exact().routes.size() > 1) {
      behind.graph = RoutesOf(study->exact());
    }
  } else {
    behind.graph = {GrownBy(result.planner), result.numbers.graph.points,
                    result.numbers.graph.edges};
  }
  return behind;
}

ViewBehind BehindTrajectory(const TrajectoryStudy& study,
                            const PipelineResult& result,
                            const PathHistory& history) {
  ViewBehind behind;
  if (study.model() == "window") behind.window = study.Region();
  behind.iterates = IteratesOf(study, result, history);
  if (WasPolished(result)) {
    behind.planes = CorridorAround(study, result.path);
  }
  return behind;
}

}  // namespace phongpd
