// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: paths of poses by Ipopt: how many are free for all t, with rows at
// samples alone, and by Optimize, which proves it.  One JSON row a run.  Times
// are processor seconds.
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "planners/rigid/optimizer/path_starts.h"
#include "planners/rigid/optimizer/pose_rounds.h"
#include "planners/rigid/optimizer/rigid_optimize.h"
#include "problems/scenes/rigid_scenes.h"
#include "problems/shapes/shapes.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;
using RigidPath = std::vector<RobotPose>;

TriangleMesh Bar() { return MakeBox({-1.0, -0.2, -0.2}, {1.0, 0.2, 0.2}); }

// A bar longer than the hole is wide has to turn to go through.
RigidScene Slot() {
  RigidScene s;
  s.robot = Bar();
  s.obstacles = {MakePlateWithHole(6.0, 0.4, 1.6)};
  s.start.position = {0.2, 0.1, 2.0};
  s.goal.position = {-0.3, 0.2, -2.0};
  s.goal.orientation = AngleAxisd(0.4, Vector3d(0.0, 1.0, 1.0).normalized());
  s.bounds = {{-2.5, -2.5, -3.0}, {2.5, 2.5, 3.0}};
  return s;
}

// A bar around the outer corner of an L, from leg to leg.
RigidScene Corner() {
  RigidScene s;
  s.robot = Bar();
  s.obstacles = {MakeL(4.0, 1.0, 2.0)};
  s.start.position = {-0.6, 2.0, 1.0};
  s.start.orientation = AngleAxisd(0.5 * kPi, Vector3d::UnitZ());
  s.goal.position = {2.0, -0.6, 1.0};
  s.bounds = {{-3.0, -3.0, -0.5}, {5.0, 5.0, 2.5}};
  return s;
}

RigidScene SceneOf(const std::string& name) {
  if (name == "slot") return Slot();
  if (name == "corner") return Corner();
  return MakeRigidScene(name);
}

RigidOptimizeRequest RequestOf(const RigidScene& scene, unsigned seed) {
  RigidOptimizeRequest request;
  request.task.start = scene.start;
  request.task.goal = scene.goal;
  request.task.bounds = {scene.bounds.min, scene.bounds.max};
  request.task.seed = seed;
  request.task.threads = 1;  // limit and seconds are of the processor
  request.start_noise = 0.02;
  return request;
}

// What came of a run; lengths in the object norm.
struct Outcome {
  std::string status, solver, by;
  bool is_certified = false;  // free for all t, proved
  bool was_refuted = false;   // what Ipopt called solved does collide
  double planned_length = 0.0, length = 0.0;
  int rounds = 0, iterations = 0;
  std::size_t samples = 0;
};

// What optimisers do that have rows at samples alone: the rows and settings of
// the first round of Optimize, solved once and not looked at before the end.
Outcome SolveAtSamples(const RigidWorld& world,
                       const RigidOptimizeRequest& request, double limit) {
  const RigidPath start =
      internal::StraightStart(world, request, request.task.bounds);
  internal::PoseRows rows(world.model(), 6, 0.25 * world.reach(), false);
  const std::vector<internal::PoseSample> samples = internal::FirstSamples(
      static_cast<int>(start.size()) - 1, 1e-3 * world.reach());
  internal::PoseProgram program(
      internal::PoseChart(start, world.reach(), world.gyration()), samples,
      request.task.bounds, &rows);
  const double begin = CpuSeconds();
  IpoptSettings settings;
  settings.max_iterations = 100;
  settings.stall_iterations = 10;
  settings.on_iteration = [&](const IterationRecord&, const Eigen::VectorXd&) {
    return CpuSeconds() - begin < limit;
  };
  const IpoptRun run = SolveWithIpopt(
      &program, Eigen::VectorXd::Zero(program.variables()), settings);
  const RigidPath path = program.chart().Poses(run.x.data());
  Outcome outcome;
  outcome.is_certified = true;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    outcome.is_certified &=
        world.judge().Check(RigidMotion(path[i], path[i + 1])).IsFree();
    outcome.length += world.Distance(path[i], path[i + 1]);
  }
  outcome.solver = outcome.status = ToString(run.status);
  outcome.by = "straight";
  outcome.was_refuted = IsClassOk(run.status) && !outcome.is_certified;
  outcome.rounds = 1;
  outcome.iterations = run.iterations;
  outcome.samples = samples.size();
  return outcome;
}

Outcome SolveByOptimize(const RigidWorld& world, RigidOptimizeRequest request,
                        const std::string& method, double limit) {
  const std::string tracked = "tracked ";
  request.is_tracked = method.rfind(tracked, 0) == 0;
  request.from = ParseRigidStart(
      request.is_tracked ? method.substr(tracked.size()) : method, "--methods");
  // The clock of a machine that others use ends it later.
  const double begin = CpuSeconds();
  request.task.time_limit = 100.0 * (1.0 + limit);
  request.task.is_interrupted = [&] { return CpuSeconds() - begin > limit; };
  const RigidOptimum found = Optimize(world, request);
  Outcome outcome;
  outcome.status = ToString(found.answer.status);
  outcome.solver = ToString(found.solver);
  outcome.by = found.answer.planner;
  outcome.is_certified = !found.answer.path.empty();
  outcome.was_refuted = found.was_refuted;
  outcome.planned_length = found.planned_length;
  outcome.length = found.answer.length;
  outcome.rounds = found.rounds;
  outcome.iterations = found.iterations;
  outcome.samples = found.samples;
  return outcome;
}

void Print(const std::string& scene, const std::string& method, unsigned seed,
           double limit, const Outcome& outcome, double seconds) {
  const nlohmann::ordered_json row = {
      {"scene", scene},
      {"method", method},
      {"seed", seed},
      {"limit", limit},
      {"status", outcome.status},
      {"solver", outcome.solver},
      {"by", outcome.by},
      {"certified", outcome.is_certified},
      {"refuted", outcome.was_refuted},
      {"planned_length", outcome.planned_length},
      {"length", outcome.length},
      {"rounds", outcome.rounds},
      {"iterations", outcome.iterations},
      {"samples", outcome.samples},
      {"cpu_seconds", seconds}};
  std::cout << row.dump() << std::endl;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->Options("Paths of poses by Ipopt, judged for all t.");
  std::vector<std::string> scenes = {"slot",  "window:4", "corner",
                                     "peg:1", "ell:2.5",  "bugtrap:0.3"};
  std::vector<std::string> methods = {"samples", "straight", "planner", "both"};
  unsigned first = 1, seeds = 10;
  double limit = 10.0;
  app.add_option("--scenes", scenes, "slot, corner, or FAMILY:VALUE")
      ->capture_default_str();
  app.add_option("--methods", methods,
                 "samples (one solve), straight, planner or both; 'tracked "
                 "straight'")
      ->capture_default_str();
  app.add_option("--seed", first)->capture_default_str();
  app.add_option("--seeds", seeds)->capture_default_str();
  app.add_option("--limit", limit, "Processor seconds of a run")
      ->capture_default_str();
  program->Parse();
  for (unsigned seed = first; seed < first + seeds; ++seed) {
    for (const std::string& name : scenes) {
      const RigidScene scene = SceneOf(name);
      const RigidWorld world({scene.robot}, scene.obstacles);
      const RigidOptimizeRequest request = RequestOf(scene, seed);
      for (const std::string& method : methods) {
        const double begin = CpuSeconds();
        const Outcome outcome =
            method == "samples"
                ? SolveAtSamples(world, request, limit)
                : SolveByOptimize(world, request, method, limit);
        Print(name, method, seed, limit, outcome, CpuSeconds() - begin);
      }
    }
  }
  return 0;
}

}  // namespace phongpd::bench
