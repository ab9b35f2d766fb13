// SPDX-License-Identifier: GPL-3.0-or-later
// Purpose: paths of poses by Ipopt: how many of what it calls solved are free
// for all t, with rows at samples alone and with rows where the judge finds a
// collision between them.  One JSON row a run.  Times are processor seconds.
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "planners/rigid/optimizer/rigid_optimize.h"
#include "problems/scenes/rigid_scenes.h"
#include "problems/shapes/shapes.h"
#include "results/bench/program.h"

namespace phongpd::bench {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

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

RigidOptimizeRequest RequestOf(const RigidScene& scene,
                               const std::string& method) {
  RigidOptimizeRequest request;
  request.task.start = scene.start;
  request.task.goal = scene.goal;
  request.task.bounds = {scene.bounds.min, scene.bounds.max};
  request.start_noise = 0.02;
  if (method == "samples") {
    request.from = RigidStart::kStraight;
    request.max_rounds = 1;
  } else {
    const std::string tracked = "tracked ";
    request.is_tracked = method.rfind(tracked, 0) == 0;
    request.from = ParseRigidStart(
        request.is_tracked ? method.substr(tracked.size()) : method,
        "--methods");
  }
  return request;
}

}  // namespace

int Run(Program* program) {
  CLI::App& app =
      program->Options("Paths of poses by Ipopt, judged for all t.");
  std::vector<std::string> scenes = {"slot",  "window:4", "corner",
                                     "peg:1", "ell:2.5",  "bugtrap:0.3"};
  std::vector<std::string> methods = {"samples", "both"};
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
      for (const std::string& method : methods) {
        RigidOptimizeRequest request = RequestOf(scene, method);
        request.task.seed = seed;
        // The clock of a machine that others use ends it later.
        const double begin = CpuSeconds();
        request.task.time_limit = 100.0 * (1.0 + limit);
        request.task.is_interrupted = [&] {
          return CpuSeconds() - begin > limit;
        };
        const RigidOptimum found = Optimize(world, request);
        const nlohmann::ordered_json row = {
            {"scene", name},
            {"method", method},
            {"seed", seed},
            {"limit", limit},
            {"status", ToString(found.answer.status)},
            {"by", found.answer.planner},
            {"solver", ToString(found.solver)},
            {"claimed", found.is_confirmed || found.was_refuted},
            {"confirmed", found.is_confirmed},
            {"refuted", found.was_refuted},
            {"certified", !found.answer.path.empty()},
            {"length", found.answer.length},
            {"planned_length", found.planned_length},
            {"rounds", found.rounds},
            {"iterations", found.iterations},
            {"samples", found.samples},
            {"added_samples", found.added_samples},
            {"seconds", CpuSeconds() - begin}};
        std::cout << row.dump() << std::endl;
      }
    }
  }
  return 0;
}

}  // namespace phongpd::bench
