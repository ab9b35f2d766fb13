// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/rigid_answer.h"

#include <initializer_list>
#include <nlohmann/json.hpp>

#include "problems/cli/command.h"
#include "problems/output/text.h"
#include "problems/studies/rigid_row.h"
#include "viewer/rigid_view.h"

namespace phongpd::cli {
namespace {

RunSummary Summarize(const nlohmann::ordered_json& row) {
  const std::string status = row.at("status").get<std::string>();
  const std::string planner = row.at("planner").get<std::string>();
  const std::string seed = std::to_string(row.at("seed").get<std::uint64_t>());
  RunSummary summary;
  summary.path = NamedPathOf(row);
  summary.line = row.at("scene").get<std::string>() + ", " + planner + ", " +
                 seed + ": " + status + ", " +
                 Rounded(NumberAt(row, "/seconds/solve")) + ", " +
                 std::to_string(row.at("path").size()) + ", " +
                 Rounded(NumberAt(row, "/path_length"), 4);
  summary.why = row.at("reason").get<std::string>();
  return summary;
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

// A run for each seed, by row_of(world, seed).
template <typename RowOf>
int AnswerRuns(const SeededRunFlags& flags, const SceneSource& source,
               const TurningScene& scene, const RowOf& row_of) {
  SeededRuns runs(flags, source,
                  "scene, planner, seed: status, seconds, poses, length (of "
                  "positions and, by the radius of gyration, of turns)",
                  Summarize);
  for (const std::string& warning : scene.warnings) Warn(warning);
  const RigidWorld world = RigidWorldOf(scene);
  for (int i = runs.kept(); i < flags.runs; ++i) {
    Progress("run " + std::to_string(i + 1) + " of " +
             std::to_string(flags.runs));
    runs.Add(row_of(world, flags.seed + static_cast<std::uint64_t>(i)));
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
  request.Validate();
  return AnswerRuns(flags, source, scene,
                    [&](const RigidWorld& world, std::uint64_t seed) {
                      request.seed = seed;
                      return RigidRow(scene, request, Plan(world, request));
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
      flags, source, scene, [&](const RigidWorld& world, std::uint64_t seed) {
        request.task.seed = seed;
        return RigidOptimumRow(scene, request, Optimize(world, request));
      });
}

}  // namespace phongpd::cli
