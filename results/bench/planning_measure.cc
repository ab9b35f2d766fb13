// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/planning_measure.h"

#include <algorithm>
#include <limits>
#include <random>

#include "core/bvh/triangle_bvh.h"
#include "core/stopwatch.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/path_shortening.h"
#include "planners/retraction/retraction_names.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/random_vector.h"
#include "results/bench/report.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

PlanningProblem Make(const std::string& family, const std::string& knobs,
                     double delta, bool is_turned, bool is_feasible) {
  PlanningProblem problem;
  problem.family = family;
  problem.delta = delta;
  problem.is_turned = is_turned;
  problem.is_feasible = is_feasible;
  problem.scene = family + ":delta=" + FormatDouble(delta);
  if (!knobs.empty()) problem.scene += "," + knobs;
  if (!is_feasible) problem.scene += ",twin=1";
  if (is_turned) problem.scene += ",rotation_seed=1";
  return problem;
}

struct Family {
  const char* name;
  const char* knobs;
};
constexpr Family kFamilies[] = {
    {"gap", ""},           {"hole", ""},          {"tunnel", "bends=1"},
    {"tunnel", "bends=3"}, {"tunnel", "bends=5"}, {"keyhole", ""},
    {"comb", ""},          {"snake", ""},         {"bugtrap", ""},
    {"clutter_hole", ""},  {"maze", "n=3"},       {"maze", "n=4"},
    {"maze", "n=6"}};

// Is q in the channel: within δ of a place of the witness that is as narrow as
// the channel?
std::function<bool(const Vector3d&)> InPassage(const Scene& scene,
                                               const FreeSpace& space,
                                               double delta) {
  const std::vector<Vector3d>& path = scene.witness;
  if (path.size() < 2) return nullptr;
  return [&path, &space, delta](const Vector3d& q) {
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const Vector3d way = path[k + 1] - path[k];
      const double t = std::clamp(
          (q - path[k]).dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0,
          1.0);
      const Vector3d nearest = path[k] + t * way;
      if ((q - nearest).norm() <= delta &&
          space.Clearance(nearest) <= 0.51 * delta) {
        return true;
      }
    }
    return false;
  };
}

// Uniform samples until the planner had its first point there; −1: it had none,
// or does not count them.
double SamplesTo(const std::function<bool(const Vector3d&)>& is_there,
                 const GrownGraph& graph) {
  if (!is_there) return -1.0;
  for (std::size_t i = 0; i < graph.samples.size(); ++i) {
    if (is_there(graph.points[i])) return static_cast<double>(graph.samples[i]);
  }
  return -1.0;
}

SamplerRun RunOnce(const Scene& scene, const World& world,
                   const PlanRequest& request, double delta) {
  const PathAnswer answer = Plan(world, request);
  const OmplPlanningResult& n = answer.plan->search;
  SamplerRun measured;
  measured.is_solved = answer.is_solved;
  measured.is_false = n.solved && !n.collision_free;
  measured.seconds = n.seconds;
  measured.samples = static_cast<double>(n.samples);
  measured.samples_to_passage = SamplesTo(
      InPassage(scene, *world.Spaces(SpaceLayout::kSealed).free_space, delta),
      n.graph);
  measured.collision_checks = static_cast<double>(n.collision_checks);
  measured.segment_checks = static_cast<double>(n.segment_checks);
  measured.retractions = static_cast<double>(n.retractions);
  measured.length = n.length;
  measured.clearance = n.clearance;
  return measured;
}

}  // namespace

std::vector<PlanningProblem> ExactProblems() {
  std::vector<PlanningProblem> problems;
  for (const Family& family : kFamilies) {
    for (const bool is_turned : {false, true}) {
      for (const double delta : {2e-2, 1e-3, 1e-4, 2e-5}) {
        problems.push_back(
            Make(family.name, family.knobs, delta, is_turned, true));
      }
      problems.push_back(
          Make(family.name, family.knobs, 1e-3, is_turned, false));
    }
  }
  return problems;
}

std::vector<PlanningProblem> SamplerProblems() {
  std::vector<PlanningProblem> problems;
  for (const Family& family : kFamilies) {
    const std::string name = family.name;
    const std::string knobs = family.knobs;
    if (knobs == "bends=1" || knobs == "n=6") continue;
    const double delta = name == "gap" ? 0.1 : 1e-3;
    problems.push_back(Make(name, knobs, delta, false, true));
  }
  for (const char* name : {"hole", "bugtrap"}) {
    problems.push_back(Make(name, "", 1e-3, true, true));
  }
  return problems;
}

std::vector<PlanningProblem> NarrowingProblems() {
  std::vector<PlanningProblem> problems;
  for (const char* name : {"hole", "snake", "bugtrap"}) {
    for (const double delta : {2e-2, 2e-3, 2e-4, 2e-5}) {
      problems.push_back(Make(name, "", delta, false, true));
    }
  }
  return problems;
}

ExactRow MeasureExact(const PlanningProblem& problem) {
  ExactRow row;
  row.problem = problem;
  const Scene scene = SceneSource(problem.scene).Load();
  const World world(scene.workspace, scene.name);
  const ContactSpace& sealed = world.Sealed();
  const FreeSpace& free_space = *world.Spaces(SpaceLayout::kSealed).free_space;
  row.contact_space_milliseconds = 1e3 * world.Report().seconds;
  row.triangles = sealed.mesh().triangles.size();
  ContactSurfaceOptions options;
  const ContactSurfacePlanner planner(sealed, options);
  row.build_milliseconds = 1e3 * planner.build_seconds();
  std::vector<double> milliseconds;
  PlanResult plan;
  for (int i = 0; i < 5; ++i) {
    plan = planner.Plan(scene.start, scene.goal);
    milliseconds.push_back(1e3 * plan.seconds);
  }
  row.milliseconds = Quantile(milliseconds, 0.5);
  row.status = ToString(plan.status);
  row.length = plan.length;
  row.clearance = plan.clearance;
  if (scene.witness.size() > 1 && CheckPath(free_space, scene.witness).free) {
    ShorteningOptions shortest;
    shortest.random_cuts = 2000;
    shortest.pulls = 100;
    row.witness_length =
        PathLength(ShortenPath(scene.witness, sealed.bvh(), shortest));
  }
  row.is_right = problem.is_feasible
                     ? plan.status == PathStatus::kSolved &&
                           CheckPath(free_space, plan.path).free
                     : plan.status == PathStatus::kInfeasibleProved;
  return row;
}

std::vector<SamplerRow> MeasureSamplers(
    const PlanningProblem& problem, const std::vector<std::string>& planners,
    const PlanningOptions& options) {
  const Scene scene = SceneSource(problem.scene).Load();
  const World world(scene.workspace, scene.name);
  std::vector<SamplerRow> rows;
  for (const std::string& planner : planners) {
    SamplerRow row;
    row.problem = problem;
    row.planner = planner;
    const std::size_t space = planner.find(' ');
    PlanRequest request = PlanRequestOf(scene);
    request.planner = ParsePlanner(planner.substr(0, space), "planner");
    if (space != std::string::npos) {
      request.retraction =
          ParseRetraction(planner.substr(space + 1), "retraction");
    }
    request.model = Model::kFull;  // the same for all planners
    request.time_limit = options.limit;
    request.verifies = false;
    int solved = 0;
    for (int i = 0; i < options.seeds; ++i) {
      if (i == options.hopeless && solved == 0) break;
      request.seed = options.seed + static_cast<std::uint64_t>(i);
      row.runs.push_back(RunOnce(scene, world, request, problem.delta));
      solved += row.runs.back().is_solved;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

MotionRow MeasureMotions(const std::string& scene, std::uint64_t seed) {
  const Scene loaded = SceneSource(scene).Load();
  const World world(loaded.workspace, loaded.name);
  const WorldSpaces& merged = world.Spaces(SpaceLayout::kMerged);
  const FreeSpace& free_space = *merged.free_space;
  const TriangleMesh& mesh = merged.spaces.front().mesh();
  BoundingBox box = ComputeBounds(mesh);
  const Vector3d margin = 0.1 * (box.max - box.min);
  box = {box.min - margin, box.max + margin};
  std::mt19937_64 random(seed);
  MotionRow row;
  row.scene = scene;
  row.triangles = merged.triangles;
  std::vector<double> microseconds;
  constexpr int kMotions = 2000, kRepeats = 20;
  // Ends near the surface: what planners ask, and the slower case.
  std::uniform_real_distribution<double> size(-0.05, 0.05);
  while (static_cast<int>(microseconds.size()) < kMotions) {
    const SurfacePoint point = RandomSurfacePoint(mesh, &random);
    const auto near = [&] {
      return Vector3d(point.position +
                      world.diagonal() * RandomVector(&size, &random));
    };
    const Vector3d a = near(), b = near();
    if (!free_space.IsFree(a)) continue;
    bool is_free = false;
    const Stopwatch stopwatch;
    for (int i = 0; i < kRepeats; ++i) is_free = free_space.IsFree(a, b);
    microseconds.push_back(1e6 * stopwatch.Seconds() / kRepeats);
    row.blocked_share += is_free ? 0.0 : 1.0 / kMotions;
  }
  row.median_microseconds = Quantile(microseconds, 0.5);
  row.slow_microseconds = Quantile(microseconds, 0.95);
  return row;
}

}  // namespace phongpd::bench
