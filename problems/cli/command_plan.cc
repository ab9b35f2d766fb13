// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "problems/cli/command.h"
#include "problems/output_files.h"
#include "problems/planning_study.h"
#include "problems/scene_source.h"
#include "problems/text.h"

namespace phongpd::cli {
namespace {

struct Flags {
  std::string scene;
  std::string planner;
  std::string metric = "phong";
  std::string time_limit;
  std::uint64_t seed = 1;
  int runs = 1;
  std::string output;
  std::string html;
  std::string svg;
  std::string ompl_log;
  bool no_cache = false;
};

void PrintHeader() {
  std::cout << "scene, planner, seed: status, seconds (without contact "
               "space), points, length, clearance\n";
}

int Plan(const Flags& flags) {
  if (flags.runs < 1) {
    throw InputError("--runs: expected at least 1, found " +
                     std::to_string(flags.runs));
  }
  const Scene scene = SceneSource(flags.scene).Load();
  PlanningRun run;
  run.planner = flags.planner.empty() ? scene.planning.planner : flags.planner;
  run.retraction = flags.metric;
  run.time_limit = scene.planning.time_limit;
  if (!flags.time_limit.empty()) {
    run.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  if (!flags.ompl_log.empty()) CheckHasOmplLog(run.planner);
  OutputFiles outputs;
  outputs.Declare(flags.output);
  DeclarePictures(&outputs, flags.html, flags.svg);
  if (!flags.ompl_log.empty()) outputs.Declare(flags.ompl_log);
  SilenceOmpl();
  ContactSpaceCache cache;
  if (!flags.no_cache) cache.directory = DefaultCacheDirectory();
  PlanningStudy study(scene, cache);
  TellAbout(scene, study.space());
  const bool silent = outputs.UseStandardOutput();
  PathScene picture;
  std::string lines;
  bool is_answered = true;
  for (int i = 0; i < flags.runs; ++i) {
    run.seed = flags.seed + static_cast<std::uint64_t>(i);
    Progress("run " + std::to_string(i + 1) + " of " +
             std::to_string(flags.runs));
    const PlanningResult result = study.Run(run);
    lines += PlanningRow(study, run, result).dump() + '\n';
    picture.paths.push_back({run.planner + ", seed " +
                                 std::to_string(run.seed) + ": " +
                                 result.status,
                             result.numbers.path, result.solved});
    is_answered = is_answered && result.solved;
    if (silent) continue;
    if (i == 0) PrintHeader();
    std::cout << scene.name << ", " << run.planner << ", " << run.seed << ": "
              << result.status << ", " << Rounded(result.numbers.seconds)
              << ", " << result.numbers.path.size() << ", "
              << Rounded(result.numbers.length, 4) << ", "
              << Rounded(result.numbers.clearance) << '\n';
    if (!result.reason.empty()) std::cout << "  " << result.reason << '\n';
  }
  outputs.Write(flags.output, lines);
  picture.title = scene.name;
  picture.contact_meshes = {study.VisibleMesh()};
  picture.robot = scene.workspace.robot;
  WritePictures(&outputs, flags.html, flags.svg, picture);
  if (!flags.ompl_log.empty()) {
    Progress("running OMPL's benchmark");
    outputs.Write(flags.ompl_log, study.OmplLog(run, flags.runs));
  }
  outputs.Commit();
  return is_answered ? kDone : kNoAnswer;
}

}  // namespace

Command AddPlan(CLI::App* app) {
  auto flags = std::make_shared<Flags>();
  app->add_option("scene", flags->scene,
                  "Scene file, or FAMILY:key=value,... (see scenes list)")
      ->required()
      ->type_name("SCENE");
  app->add_option("--planner", flags->planner,
                  "contact-surface is complete, deterministic and proves "
                  "infeasibility; the others sample (scene's own if not set)")
      ->check(CLI::IsMember(PlannerNames()));
  app->add_option("--metric", flags->metric,
                  "How retraction planners carry colliding samples to the "
                  "contact space: along all Phong branches, one of them, to "
                  "the nearest point, or to a random one")
      ->check(CLI::IsMember(RetractionNames()))
      ->capture_default_str();
  app->add_option("--time", flags->time_limit,
                  "Limit of a run by a sampler, seconds (scene's own if not "
                  "set)")
      ->type_name("S");
  app->add_option("--seed", flags->seed, "Of the first run")
      ->check(CLI::NonNegativeNumber)
      ->type_name("S")
      ->capture_default_str();
  app->add_option("--runs", flags->runs, "Runs, with seeds S, S+1, ...")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--output", flags->output, "JSON Lines, one object a run")
      ->required()
      ->type_name("FILE");
  app->add_option("--ompl-log", flags->ompl_log,
                  "Also run OMPL's own benchmark on the planner and write its "
                  "log, which OMPL's statistics script reads")
      ->type_name("FILE");
  AddPictures(app, &flags->html, &flags->svg);
  AddNoCache(app, &flags->no_cache);
  return [flags] { return Plan(*flags); };
}

}  // namespace phongpd::cli
