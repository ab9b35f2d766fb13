// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/run_view.h"

#include <algorithm>

namespace phongpd {
namespace {

// What people call what the planner grows.
std::string GrownBy(PlannerId planner) {
  switch (planner) {
    case PlannerId::kRetractionRrt:
      return "retraction tree";
    case PlannerId::kRetractionForest:
      return "retraction trees";
    case PlannerId::kRrtConnect:
      return "the planner's trees";
    default:
      return "roadmap";
  }
}

ViewGraph RoutesOf(const std::vector<Path>& routes) {
  ViewGraph graph;
  graph.name = "routes compared";
  for (const Path& route : routes) {
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

std::vector<ViewPlane> CorridorAround(const TrajectoryProblem& problem,
                                      const Path& path) {
  std::vector<ViewPlane> planes;
  for (const CorridorPlane& plane : PlanesAround(problem, path)) {
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

ViewIterates IteratesOf(const TrajectoryProblem& problem,
                        const PipelineResult& result,
                        const PathHistory& history) {
  ViewIterates iterates;
  iterates.count = history.count();
  for (const PathHistory::Entry& entry : history.Kept()) {
    const PathIterate& iterate = entry.iterate;
    iterates.kept.push_back({entry.number, SpokenStage(iterate, result),
                             iterate.record.is_restoration,
                             CheckPath(*problem.free_space, iterate.path).free,
                             PathEnergy(problem, iterate.path),
                             iterate.record.violation, iterate.path});
  }
  return iterates;
}

}  // namespace

ViewBehind BehindPlan(const World& world, const PlanRequest& request,
                      const PathAnswer& answer) {
  ViewBehind behind;
  if (answer.evidence.model == Model::kWindow) {
    behind.window = PlanningRegion(world, request);
  }
  const PlanWork& work = *answer.plan;
  if (work.planner != PlannerId::kContactSurface) {
    behind.graph = {GrownBy(work.planner), work.search.graph.points,
                    work.search.graph.edges};
  } else if (work.routes.size() > 1) {  // one route is the path itself
    behind.graph = RoutesOf(work.routes);
  }
  return behind;
}

ViewBehind BehindTrajectory(const World& world, const OptimizeRequest& request,
                            const PathAnswer& answer,
                            const PathHistory& history) {
  ViewBehind behind;
  if (answer.evidence.model == Model::kWindow) {
    behind.window = WindowRegion(world, request.start, request.goal);
  }
  if (!answer.evidence.model) return behind;  // nothing ran
  const TrajectoryProblem problem =
      ProblemOf(world, request, *answer.evidence.model);
  behind.iterates = IteratesOf(problem, *answer.pipeline, history);
  if (WasPolished(*answer.pipeline)) {
    behind.planes = CorridorAround(problem, answer.path);
  }
  return behind;
}

TriangleMesh VisibleMesh(const ContactSpace& space, const BoundingBox& region) {
  const double rounding = 1e-9 * region.Diagonal();
  const TriangleMesh& all = space.mesh();
  const std::vector<ContactKind>& kinds = space.kind();
  TriangleMesh visible;
  std::vector<int> shown(all.vertices.size(), -1);  // their numbers there
  for (std::size_t i = 0; i < all.triangles.size(); ++i) {
    if (!kinds.empty() && kinds[i] == ContactKind::kNone) continue;
    const Triangle& t = all.triangles[i];
    const bool is_within = std::all_of(t.begin(), t.end(), [&](int v) {
      const Eigen::Vector3d& p = all.vertices[v];
      return (p.array() >= region.min.array() - rounding).all() &&
             (p.array() <= region.max.array() + rounding).all();
    });
    if (!is_within) continue;
    for (const int v : t) {
      if (shown[v] >= 0) continue;
      shown[v] = static_cast<int>(visible.vertices.size());
      visible.vertices.push_back(all.vertices[v]);
    }
    visible.triangles.push_back({shown[t[0]], shown[t[1]], shown[t[2]]});
  }
  return visible;
}

}  // namespace phongpd
