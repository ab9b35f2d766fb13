// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "planners/world/bare_length.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/cli/timed_answer.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/points_csv.h"
#include "problems/scenes/scene_source.h"

namespace phongpd::cli {
namespace {

struct RetimeFlags : TimedFlags {
  std::string path;
  std::string scene;
  std::string root;
  std::string repair = "reject";
  std::string preset;
  std::string margin;
};

// Figures: curve_optimizer.h.
constexpr char kRetimePresetHelp[] =
    "How long a faster curve is looked for; tight takes twice the time of "
    "balanced";

int AnswerRetime(RetimeFlags flags) {
  const std::vector<Eigen::Vector3d> path = ReadPointsCsv(flags.path);
  if (path.size() < 2) {
    throw InputError(flags.path + ": expected two rows at least, found " +
                     std::to_string(path.size()));
  }
  const SceneSource source(flags.scene, flags.root,
                           ParseRepair(flags.repair, "--repair"));
  Scene scene = source.Load();
  scene.start = path.front();
  scene.goal = path.back();
  scene.via.clear();
  scene.duration = 0.0;
  scene.departure = scene.arrival = {};
  SetTask(flags.motion, &scene);
  SetPreset(flags.preset, &scene);
  flags.has_margin = !flags.margin.empty();
  if (flags.has_margin) {
    scene.trajectory.margin = ParseClearance(
        flags.margin, "--margin", ContactBounds(scene.workspace).Diagonal(),
        scene.workspace.unit);
  }
  const std::optional<MotionLimits> limits = LimitsOf(flags.motion, scene);
  if (!limits) {
    throw InputError(
        "--limits: expected V,A,J, or limits in the scene, found none");
  }
  scene.limits = limits;
  return AnswerInTime(scene, flags,
                      [&](const World& world, const OptimizeRequest& request) {
                        return Retime(world, path, request);
                      });
}

}  // namespace

Command AddRetime(CLI::App* app) {
  auto flags = std::make_shared<RetimeFlags>();
  app->add_option("path", flags->path,
                  "CSV file with the columns x,y,z, a row a point of the path")
      ->required()
      ->type_name("FILE");
  app->add_option("--scene", flags->scene,
                  "What the path is free among: scene file, or "
                  "FAMILY:key=value,... (see scenes list)")
      ->required()
      ->type_name("SCENE");
  AddRoot(app, &flags->root);
  AddRepair(app, &flags->repair);
  AddMotion(app, "scene's own if not set", "none if not set, not the scene's",
            &flags->motion);
  CLI::Option* const via = app->get_option("--via");
  via->description(via->get_description() + "; a point of the path");
  AddPreset(app, kRetimePresetHelp, &flags->preset);
  app->add_option("--margin", flags->margin,
                  "Distance to keep where there is room, more than 0 and at "
                  "most D, the diagonal of the obstacles' contact space: 0.01 "
                  "or 0.01D is a share of D, 0.5unit is in the scene's unit "
                  "(scene's own if not set)")
      ->type_name("LENGTH");
  app->add_flag("--require", flags->require,
                "Less than the margin is no answer: status clearance_missed, "
                "exit code 1");
  app->add_option("--time", flags->time_limit,
                  "Limit of the search for a faster curve, seconds")
      ->transform(SecondsFromZero())
      ->type_name("S");
  app->add_option("--output", flags->output,
                  "Bézier pieces as JSON, rows in time as FILE.csv or, for "
                  "ROS 2, FILE.yaml (joints x, y, z) or FILE.multidof.yaml, "
                  "lines as FILE.gcode (a sentence is all if "
                  "not set)")
      ->type_name("FILE");
  app->add_option("--html", flags->html,
                  "Page that plays the motion in its own time, beside what it "
                  "asks of the limits")
      ->type_name("FILE");
  AddVerify(app, &flags->verify);
  AddJson(app, &flags->json, "The JSON on standard output without --output");
  AddNoCache(app, &flags->no_cache);
  AddExamples(app, {"phongpd retime path.csv --scene scene.json --limits "
                    "500,2000,20000 --output t.json",
                    "phongpd retime path.csv --scene scene.json --limits "
                    "1/1/0.5,2,10 --rate 250 --output t.csv"});
  return [flags] { return AnswerRetime(*flags); };
}

}  // namespace phongpd::cli
