// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/rigid_answer.h"

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

}  // namespace

int AnswerRigidPlan(const SeededRunFlags& flags, const SceneSource& source) {
  // What steers planners of robots that translate says nothing.
  for (const char* name :
       {"--preset", "--planner", "--metric", "--model", "--routes",
        "--max-seconds", "--max-mib", "--clearance", "--require", "--ompl-log",
        "--svg", "--verify", "--explain"}) {
    if (flags.app->count(name) == 0) continue;
    throw InputError(std::string(name) +
                     ": expected none for a robot that turns, found one");
  }
  TurningScene scene = source.LoadTurning();
  if (!flags.time_limit.empty()) {
    scene.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  RigidRequest request = RigidRequestOf(scene);
  request.Validate();
  SeededRuns runs(flags, source,
                  "scene, planner, seed: status, seconds, poses, length (of "
                  "positions and, by the radius of gyration, of turns)",
                  Summarize);
  for (const std::string& warning : scene.warnings) Warn(warning);
  const RigidWorld world = RigidWorldOf(scene);
  for (int i = runs.kept(); i < flags.runs; ++i) {
    request.seed = flags.seed + static_cast<std::uint64_t>(i);
    Progress("run " + std::to_string(i + 1) + " of " +
             std::to_string(flags.runs));
    runs.Add(RigidRow(scene, request, Plan(world, request)));
  }
  runs.Write([&] { return TurningSceneView(scene); });
  return runs.Commit();
}

}  // namespace phongpd::cli
