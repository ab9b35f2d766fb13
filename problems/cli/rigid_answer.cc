// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/rigid_answer.h"

#include <initializer_list>
#include <nlohmann/json.hpp>

#include "problems/cli/command.h"
#include "problems/cli/run_path.h"
#include "problems/output/rigid_row.h"
#include "problems/output/text.h"
#include "viewer/rigid_view.h"

namespace phongpd::cli {
namespace {

RunSummary Summarize(const TurningScene& scene, const RigidRequest& request,
                     const RigidAnswer& answer) {
  return {NamedPathOf(request, answer), false,
          RunLine(scene.name, PlannerName(answer), request.seed,
                  ToString(answer.status),
                  {Rounded(answer.seconds), std::to_string(answer.path.size()),
                   Rounded(answer.length, 4)}),
          answer.reason};
}

RunSummary SummarizeKept(const nlohmann::ordered_json& row) {
  return {NamedPathOf(row), false,
          RunLine(row.at("scene").get<std::string>(),
                  row.at("planner").get<std::string>(),
                  row.at("seed").get<std::uint64_t>(),
                  row.at("status").get<std::string>(),
                  {Rounded(NumberAt(row, "/seconds/solve")),
                   std::to_string(row.at("path").size()),
                   Rounded(NumberAt(row, "/path_length"), 4)}),
          row.at("reason").get<std::string>()};
}

// What steers others says nothing.
void RequireNone(const SeededRunFlags& flags,
                 std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (flags.app->count(name) == 0) continue;
    throw InputError(std::string(name) +
                     ": expected none for a robot that turns, found one");
  }
}

// The scene with the flags' time limit.
TurningScene SceneOf(const SeededRunFlags& flags, const SceneSource& source) {
  TurningScene scene = source.LoadTurning();
  if (!flags.time_limit.empty()) {
    scene.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  return scene;
}

// A run for each seed, by ask(world, seed, &runs).
template <typename Ask>
int AnswerRuns(const SeededRunFlags& flags, const SceneSource& source,
               const TurningScene& scene, const Ask& ask) {
  SeededRuns runs(flags, source,
                  "scene, planner, seed: status, seconds, poses, length (of "
                  "positions and, by the radius of gyration, of turns)",
                  SummarizeKept);
  for (const std::string& warning : scene.warnings) Warn(warning);
  const RigidWorld world = RigidWorldOf(scene);
  for (int i = runs.kept(); i < flags.runs; ++i) {
    Progress("run " + std::to_string(i + 1) + " of " +
             std::to_string(flags.runs));
    ask(world, flags.seed + static_cast<std::uint64_t>(i), &runs);
  }
  runs.Write([&] { return TurningSceneView(scene); });
  return runs.Commit();
}

}  // namespace

int AnswerRigidPlan(const SeededRunFlags& flags, const SceneSource& source) {
  RequireNone(flags,
              {"--budget", "--preset", "--planner", "--metric", "--model",
               "--routes", "--max-seconds", "--max-mib", "--clearance",
               "--require", "--ompl-log", "--svg", "--verify", "--explain"});
  const TurningScene scene = SceneOf(flags, source);
  RigidRequest request = RigidRequestOf(scene);
  request.threads = flags.threads;
  request.Validate();
  return AnswerRuns(
      flags, source, scene,
      [&](const RigidWorld& world, std::uint64_t seed, SeededRuns* runs) {
        request.seed = seed;
        const RigidAnswer answer = Plan(world, request);
        runs->Add(Summarize(scene, request, answer),
                  RigidRow(scene, request, answer));
      });
}

int AnswerRigidOptimize(const OptimizeFlags& flags, const SceneSource& source) {
  RequireNone(
      flags,
      {"--budget",       "--preset", "--metric",      "--smoothing-length",
       "--jacobian",     "--margin", "--require",     "--routes",
       "--line",         "--rows",   "--mu-strategy", "--polish",
       "--per-obstacle", "--model",  "--max-seconds", "--max-mib",
       "--limits",       "--via",    "--svg",         "--verify",
       "--explain"});
  const TurningScene scene = SceneOf(flags, source);
  RigidOptimizeRequest request;
  request.task = RigidRequestOf(scene);
  if (flags.app->count("--start") > 0) {
    // "repaired" is what a planner has mended.
    request.from = flags.start == "straight" ? RigidStart::kStraight
                                             : RigidStart::kPlanner;
  }
  request.start_noise = ParseDouble(flags.noise, "--start-noise");
  request.Validate();
  return AnswerRuns(
      flags, source, scene,
      [&](const RigidWorld& world, std::uint64_t seed, SeededRuns* runs) {
        request.task.seed = seed;
        const RigidOptimum found = Optimize(world, request);
        runs->Add(Summarize(scene, request.task, found.answer),
                  RigidOptimumRow(scene, request, found));
      });
}

}  // namespace phongpd::cli
