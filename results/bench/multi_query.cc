// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/multi_query.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <utility>

#include "constraints/free_space.h"
#include "planners/exact/contact_roadmap.h"
#include "planners/world/world.h"
#include "problems/scenes/scene_source.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;
using Pair = std::pair<Vector3d, Vector3d>;

std::vector<Pair> RandomPairs(const Scene& scene, const World& world, int count,
                              std::uint64_t seed) {
  const FreeSpace& free_space = *world.Spaces(SpaceLayout::kSealed).free_space;
  BoundingBox box = scene.workspace.bounds;
  if (box.IsEmpty()) box = world.Sealed().bounds();
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto point = [&] {
    Vector3d q;
    do {
      for (int k = 0; k < 3; ++k) {
        q[k] = box.min[k] + share(random) * (box.max[k] - box.min[k]);
      }
    } while (!free_space.IsFree(q));
    return q;
  };
  std::vector<Pair> pairs;
  while (static_cast<int>(pairs.size()) < count) {
    const Vector3d start = point(), goal = point();
    if (!free_space.IsFree(start, goal)) pairs.emplace_back(start, goal);
  }
  return pairs;
}

// What happens to run beside makes single queries slow, so the least counts.
PlanResult Fastest(const std::function<PlanResult()>& plan, double* seconds) {
  constexpr int kRepeats = 3;
  *seconds = std::numeric_limits<double>::infinity();
  PlanResult result;
  for (int i = 0; i < kRepeats; ++i) {
    result = plan();
    *seconds = std::min(*seconds, result.seconds);
  }
  return result;
}

void Record(const PlanResult& result, const PlanResult& by_planner,
            double seconds, const FreeSpace& space, MultiQueryRow* row) {
  row->milliseconds.push_back(1e3 * seconds);
  const bool is_solved = result.status == PathStatus::kSolved;
  row->solved += is_solved;
  row->proved += result.status == PathStatus::kInfeasibleProved;
  row->wrong += result.status != by_planner.status ||
                (is_solved && !CheckPath(space, result.path).free);
  if (!is_solved || by_planner.status != PathStatus::kSolved) return;
  row->lengths.push_back(result.length / by_planner.length);
  row->clearances.push_back(result.clearance / by_planner.clearance);
}

}  // namespace

std::vector<std::string> MultiQueryScenes() {
  return {"keyhole:delta=0.001", "maze:delta=0.001,n=6",
          "clutter_hole:delta=0.001", "clutter"};
}

std::vector<MultiQueryRow> MeasureMultiQuery(const std::string& name,
                                             int queries, std::uint64_t seed) {
  const Scene scene = SceneSource(name).Load();
  const World world(scene.workspace, scene.name);
  const ContactSpace& sealed = world.Sealed();
  const FreeSpace& free_space = *world.Spaces(SpaceLayout::kSealed).free_space;
  ContactSurfaceOptions options;
  const auto planner =
      std::make_shared<const ContactSurfacePlanner>(sealed, options);
  const ContactRoadmap roadmap(planner);
  const RoadmapReport report = roadmap.report();

  std::vector<MultiQueryRow> rows(3);
  for (MultiQueryRow& row : rows) {
    row.scene = name;
    row.triangles = sealed.mesh().triangles.size();
    row.build_milliseconds = 1e3 * report.build_seconds;
    row.nodes = report.nodes;
    row.edges = report.edges;
    row.lowered_edges = report.lowered_edges;
    row.left_out_edges = report.left_out_edges;
  }
  rows[0] = {};
  rows[0].scene = name;
  rows[0].triangles = rows[1].triangles;
  rows[0].build_milliseconds = 1e3 * planner->build_seconds();
  rows[0].planner = "planner";
  rows[1].planner = "roadmap, raw";
  rows[2].planner = "roadmap, shortened";
  RoadmapRequest raw, shortened;
  raw.shorten = false;
  for (const auto& pair : RandomPairs(scene, world, queries, seed)) {
    const Vector3d& start = pair.first;
    const Vector3d& goal = pair.second;
    double seconds = 0.0;
    const PlanResult by_planner =
        Fastest([&] { return planner->Plan(start, goal); }, &seconds);
    Record(by_planner, by_planner, seconds, free_space, &rows[0]);
    for (const std::size_t k : {1u, 2u}) {
      const RoadmapRequest& request = k == 1 ? raw : shortened;
      const PlanResult result =
          Fastest([&] { return roadmap.Plan(start, goal, request); }, &seconds);
      Record(result, by_planner, seconds, free_space, &rows[k]);
      rows[k].lazy_searches += result.searches > 0;
    }
  }
  return rows;
}

Table MultiQueryTable(const std::vector<MultiQueryRow>& rows) {
  return MakeTable(
      {"scene", "triangles", "answered by", "build ms", "nodes", "edges",
       "lowered", "left out", "solved", "proved", "wrong", "asked", "median ms",
       "max ms", "length", "longest", "clearance", "least"},
      rows, [](const MultiQueryRow& r, const auto& add) {
        const bool is_roadmap = r.nodes > 0;
        const auto count = [&](int n) {
          return is_roadmap ? Shown(n) : std::string("–");
        };
        add(r.scene, r.triangles, r.planner, r.build_milliseconds,
            count(r.nodes), count(r.edges), count(r.lowered_edges),
            count(r.left_out_edges), r.solved, r.proved, r.wrong,
            count(r.lazy_searches), Quantile(r.milliseconds, 0.5),
            Quantile(r.milliseconds, 1.0), Rounded(Quantile(r.lengths, 0.5), 4),
            Rounded(Quantile(r.lengths, 1.0), 4), Quantile(r.clearances, 0.5),
            Quantile(r.clearances, 0.0));
      });
}

}  // namespace phongpd::bench
