// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planners/ompl/ompl_planning.h"
#include "problems/cli/command.h"
#include "problems/cli/explanation.h"
#include "problems/cli/flags.h"
#include "problems/cli/fleet_answer.h"
#include "problems/cli/motion_form.h"
#include "problems/cli/optimize_flags.h"
#include "problems/cli/optimize_request.h"
#include "problems/cli/rigid_answer.h"
#include "problems/cli/run_path.h"
#include "problems/cli/seeded_runs.h"
#include "problems/cli/serve_view.h"
#include "problems/cli/timed_answer.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/answer_row.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/scenes/kept_world.h"
#include "problems/scenes/scene_source.h"
#include "viewer/run_view.h"
#include "viewer/scene_view.h"

namespace phongpd::cli {
namespace {

// What each costs and gains: results/trade.
constexpr char kOptimizePresetHelp[] =
    "fast: no second optimisation from the colliding line, in less time; "
    "tight: "
    "3 routes and the corridor always, the lowest energy in more time";

// "why not", for people, and where the path crosses.
std::string Crossing(int segment, double fraction) {
  return "the path first collides in segment " + std::to_string(segment) +
         " at fraction " + FormatDouble(fraction);
}

std::string Explanation(const std::string& reason,
                        const std::string& crossing) {
  return reason + (reason.empty() || crossing.empty() ? "" : "; ") + crossing;
}

RunSummary SummarizeTrajectory(const OptimizeFlags& flags, const Scene& scene,
                               const OptimizeRequest& request,
                               const PathAnswer& answer) {
  const PipelineResult& result = *answer.pipeline;
  const PathCheck& check = result.certificate;
  return {
      NamedPathOf(request, answer),
      answer.status == PathStatus::kClearanceMissed,
      RunLine(scene.name, MethodName(request, answer) + ", " + flags.start,
              request.options.seed, ToString(answer.status),
              {std::to_string(result.iterations), Rounded(result.objective, 5),
               Rounded(answer.clearance, 3), Rounded(result.seconds, 3)}),
      Explanation(answer.reason,
                  check.free || check.segment < 0
                      ? ""
                      : Crossing(check.segment, check.motion.fraction))};
}

RunSummary SummarizeKeptTrajectory(const OptimizeFlags& flags,
                                   const nlohmann::ordered_json& row) {
  const std::string status = row.at("status_class").get<std::string>();
  const auto& crossing = row.at("first_crossing");
  return {NamedPathOf(row), status == ToString(PathStatus::kClearanceMissed),
          RunLine(row.at("scene").get<std::string>(),
                  row.at("method").get<std::string>() + ", " + flags.start,
                  row.at("seed").get<std::uint64_t>(), status,
                  {JsonText(row.at("iterations")),
                   Rounded(NumberAt(row, "/objective"), 5),
                   Rounded(NumberAt(row, "/clearance"), 3),
                   Rounded(NumberAt(row, "/seconds/total"), 3)}),
          Explanation(row.at("reason").get<std::string>(),
                      crossing.is_null()
                          ? ""
                          : Crossing(crossing.at("segment").get<int>(),
                                     NumberAt(crossing, "/fraction")))};
}

// What the model made of the run, on stderr.
void TellTrajectoryModel(const PathAnswer& answer) {
  const PathEvidence& evidence = answer.evidence;
  if (evidence.model != Model::kWindow) return;
  const std::string made =
      answer.windows
          ? "the metric from " + std::to_string(answer.windows->boxes) +
                " boxes of the contact space"
          : "free space alone, so no metric is followed; "
            "rrt-connect where the line collides, then the corridor";
  Note("model window: " + made +
       (evidence.refusal.empty()
            ? std::string()
            : ", as the whole is refused: " + evidence.refusal));
}

// Of the paper's optimiser nothing runs, and what would steer it says nothing.
void RequireTimed(const OptimizeFlags& flags, const std::string& what) {
  for (const char* name :
       {"--budget", "--metric", "--smoothing-length", "--jacobian", "--start",
        "--start-noise", "--line", "--rows", "--mu-strategy", "--polish",
        "--per-obstacle", "--runs", "--svg"}) {
    if (flags.app->count(name) == 0) continue;
    throw InputError(std::string(name) + ": expected none for " + what);
  }
}

TimedFlags TimedFlagsOf(const OptimizeFlags& flags) {
  TimedFlags timed;
  timed.motion = flags.motion;
  if (flags.app->count("--routes") > 0) timed.routes = flags.routes;
  timed.time_limit = flags.time_limit;
  timed.output = flags.output;
  timed.html = flags.html;
  timed.serve_command = ServeCommand({flags.scene}, flags.root, flags.repair);
  timed.json = flags.json;
  timed.no_cache = flags.no_cache;
  timed.has_margin = !flags.margin.empty();
  timed.require = flags.require;
  timed.verify = flags.verify;
  timed.world = flags.limits;
  return timed;
}

// With limits the answer is a motion in time (optimize.h).
int OptimizeInTime(const OptimizeFlags& flags, const MotionLimits& limits,
                   Scene scene) {
  RequireTimed(flags,
               "a motion in time, found one; with --limits none the answer is "
               "a path without time");
  OverrideScene(flags, &scene);
  SetTask(flags.motion, &scene);
  scene.limits = limits;
  return AnswerInTime(scene, TimedFlagsOf(flags),
                      [&](const World& world, const OptimizeRequest& request) {
                        PathAnswer answer = Optimize(world, request);
                        if (flags.explain) {
                          TellExplanation(ExplainTrajectory(*flags.app, world,
                                                            request, answer));
                        }
                        return answer;
                      });
}

// Of several robots each has its own task; limits that are given hold for all.
int OptimizeRobots(const OptimizeFlags& flags, FleetScene fleet) {
  RequireTimed(flags, "several robots, found one");
  for (const char* name : {"--via", "--duration", "--departure", "--arrival"}) {
    if (flags.app->count(name) == 0) continue;
    throw InputError(std::string(name) +
                     ": expected none for several robots, each of which has "
                     "its own in the scene, found one");
  }
  for (Scene& scene : fleet.robots) {
    OverrideScene(flags, &scene);
    scene.limits = LimitsOf(flags.motion, scene);
    if (scene.limits) continue;
    throw InputError(fleet.name + ": \"" + scene.workspace.robot.name() +
                     "\": expected limits, which several robots need to keep "
                     "off each other in time, found none; give \"limits\" in "
                     "the scene or --limits V,A,J");
  }
  return AnswerFleet(std::move(fleet), TimedFlagsOf(flags),
                     flags.explain ? flags.app : nullptr);
}

// Seed 0 is the scene as it stands.
Scene SceneOfSeed(const SceneSource& source, std::uint64_t seed) {
  return seed == 0 ? source.Load() : source.Load(seed);
}

// Controllers' tables are of a motion in time.
void RequireRowsOfPaths(const OptimizeFlags& flags) {
  const std::string found = EndingOf(flags.output);
  const std::vector<std::string>& timed = MotionEndings();
  const bool is_timed =
      std::find(timed.begin(), timed.end(), found) != timed.end();
  if (!is_timed || found.rfind(".json", 0) == 0) return;
  throw InputError(
      "--output: expected the name of rows, such as .jsonl, for a "
      "path without time, found " +
      flags.output + "; a table over time needs --limits V,A,J");
}

// The runs of a scene without limits, one after the other.
class OptimizeRuns {
 public:
  // `first` is the scene of the first seed; all but it outlive this.
  OptimizeRuns(const OptimizeFlags& flags, const SceneSource& source,
               const Scene& first)
      : flags_(flags),
        source_(source),
        runs_(flags, source,
              "scene, metric, start, seed: status, iterations, objective, "
              "clearance (user's unit), seconds",
              [&flags](const auto& row) {
                return SummarizeKeptTrajectory(flags, row);
              }),
        worlds_(UserCache(flags.no_cache), flags.limits),
        scene_(first) {}

  int Answer() {
    SilenceOmpl();
    for (int run = 0; run < flags_.runs; ++run) Take(run);
    WriteAll();
    const int code = runs_.Commit();
    if (!refuted_.empty()) FailVerification(refuted_);
    return code;
  }

 private:
  // Of those that were kept the last one alone is read: the pictures may need
  // its scene.
  void Take(int run) {
    const std::uint64_t seed = flags_.seed + static_cast<std::uint64_t>(run);
    if (run > 0) scene_ = SceneOfSeed(source_, seed);
    OverrideScene(flags_, &scene_);
    OptimizeRequest request = PathRequestOf(flags_, scene_, seed);
    Progress("run " + std::to_string(run + 1) + " of " +
             std::to_string(flags_.runs) + ": " + request.penetration.Name());
    const bool is_kept = run < runs_.kept();
    if (is_kept && run + 1 < flags_.runs) return;
    const World& world = worlds_.Of(scene_);
    if (run == runs_.kept()) {
      TellAbout(scene_);
      const std::string beyond = MarginBeyondReach(world, request);
      if (!beyond.empty()) Warn(beyond);
    }
    if (is_kept) return;
    ProgressOf("runs", static_cast<std::size_t>(run - runs_.kept()),
               static_cast<std::size_t>(flags_.runs - runs_.kept()));
    Ask(world, std::move(request), run == runs_.kept());
  }

  void Ask(const World& world, OptimizeRequest request, bool is_first) {
    PathHistory history;
    if (runs_.ShowsBehind()) {
      request.options.on_path = [&history](const PathIterate& iterate) {
        history.Add(iterate);
      };
    }
    const PathAnswer answer = Optimize(world, request);
    model_ = answer.evidence.model;
    if (is_first) TellTrajectoryModel(answer);
    if (is_first && flags_.explain) {
      TellExplanation(ExplainTrajectory(*flags_.app, world, request, answer));
    }
    if (answer.status == PathStatus::kVerificationFailed && refuted_.empty()) {
      refuted_ = scene_.name + ": " + answer.reason;
    }
    runs_.Add(SummarizeTrajectory(flags_, scene_, request, answer),
              PolylineRow(scene_, world, request, answer),
              runs_.ShowsBehind()
                  ? BehindTrajectory(world, request, answer, history)
                  : ViewBehind());
  }

  // The rows, and the pictures in the world of the last run.
  void WriteAll() {
    const World& world = worlds_.Of(scene_);
    const SpaceLayout layout =
        flags_.per_obstacle ? SpaceLayout::kPerObstacle : SpaceLayout::kMerged;
    runs_.Write([&] {
      return model_ == Model::kWindow
                 ? WindowView(scene_, world)
                 : SceneView(scene_, world.Spaces(layout).Meshes());
    });
    const WorldSpaces* const built = world.Built(layout);
    TellAboutSpaces(world, built == nullptr ? 0 : built->triangles);
  }

  const OptimizeFlags& flags_;
  const SceneSource& source_;
  SeededRuns runs_;
  KeptWorld worlds_;
  Scene scene_;                 // of the last run
  std::optional<Model> model_;  // of the last that was not kept
  std::string refuted_;         // the first of them
};

int AnswerOptimize(const OptimizeFlags& flags) {
  RequireRuns(flags.runs);
  const SceneSource source(flags.scene, flags.root,
                           ParseRepair(flags.repair, "--repair"));
  if (source.turns()) return AnswerRigidOptimize(flags, source);
  if (source.has_robots()) return OptimizeRobots(flags, source.LoadFleet());
  const Scene first = SceneOfSeed(source, flags.seed);
  if (const auto limits = LimitsOf(flags.motion, first)) {
    return OptimizeInTime(flags, *limits, first);
  }
  RequireNoMotion(flags.motion);
  RequireRowsOfPaths(flags);
  return OptimizeRuns(flags, source, first).Answer();
}

}  // namespace

Command AddOptimize(CLI::App* app) {
  auto flags = std::make_shared<OptimizeFlags>();
  AddScene(app, flags.get());
  AddBudget(app, "preset, model and metric", &flags->budget);
  AddPreset(app, kOptimizePresetHelp, &flags->preset);
  AddMetricFlags(app, flags.get());
  AddStartFlags(app, flags.get());
  AddSolverFlags(app, flags.get());
  AddMotion(app,
            "a certified curve in time instead of a path; scene's own if not "
            "set; none: a path",
            "scene's own if not set", &flags->motion);
  AddModel(app, "optimise",
           "where no metric is followed: rrt-connect and the corridor",
           &flags->model);
  AddBuildLimits(app, &flags->limits.max_seconds, &flags->limits.max_mib);
  AddRuns(app,
          "Of the first run; 0 is the scene as it stands, more draw start and "
          "goal of a family, and the noise",
          flags.get());
  app->add_option("--time", flags->time_limit, "Limit of a run, seconds")
      ->transform(SecondsAboveZero())
      ->type_name("S");
  AddOutputFlags(app, flags.get());
  AddExplain(app, &flags->explain);
  AddVerify(app, &flags->verify);
  AddNoCache(app, &flags->no_cache);
  AddExamples(
      app, {"phongpd optimize u_axis",
            "phongpd optimize scene.json --margin 2unit --output run.jsonl "
            "--html run.html",
            "phongpd optimize u_axis --limits 1,2,10 --output trajectory.csv",
            "phongpd optimize plate_hole --limits 1,2,10 --via "
            "0,0,0,0.01unit,0.5 --json",
            "phongpd optimize plate:thickness=0.02 --start straight --polish "
            "never --seed 1 --runs 10 --json"});
  return [flags] { return AnswerOptimize(*flags); };
}

}  // namespace phongpd::cli
