// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "planners/retraction/retraction_names.h"
#include "planners/world/bare_length.h"
#include "problems/cli/command.h"
#include "problems/cli/explanation.h"
#include "problems/cli/flags.h"
#include "problems/cli/rigid_answer.h"
#include "problems/cli/run_path.h"
#include "problems/cli/seeded_runs.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/answer_row.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"
#include "viewer/run_view.h"
#include "viewer/scene_view.h"

namespace phongpd::cli {
namespace {

struct PlanFlags : SeededRunFlags {
  PlanFlags() { seed = 1; }

  std::string budget;
  std::string preset;
  std::string planner;
  int routes = 0;
  std::string metric = "phong";
  std::string model;
  WorldLimits limits;
  std::string clearance;
  bool require = false;
  std::string ompl_log;
  bool verify = true;
  bool explain = false;
};

RunSummary SummarizePlan(const Scene& scene, const PlanRequest& request,
                         const PathAnswer& answer) {
  return {NamedPathOf(request, answer),
          answer.status == PathStatus::kClearanceMissed,
          RunLine(scene.name, ToString(answer.plan->planner), request.seed,
                  ToString(answer.status),
                  {Rounded(answer.seconds), std::to_string(answer.path.size()),
                   Rounded(answer.length, 4), Rounded(answer.clearance)}),
          answer.reason};
}

RunSummary SummarizeKeptPlan(const nlohmann::ordered_json& row) {
  const std::string status = row.at("status").get<std::string>();
  return {NamedPathOf(row), status == ToString(PathStatus::kClearanceMissed),
          RunLine(row.at("scene").get<std::string>(),
                  row.at("planner").get<std::string>(),
                  row.at("seed").get<std::uint64_t>(), status,
                  {Rounded(NumberAt(row, "/seconds/solve")),
                   std::to_string(row.at("path").size()),
                   Rounded(NumberAt(row, "/path_length"), 4),
                   Rounded(NumberAt(row, "/clearance"))}),
          row.at("reason").get<std::string>()};
}

// What each costs and gains: results/trade.
constexpr char kPlanPresetHelp[] =
    "Of contact-surface only. fast: 1 route, no links across gaps, in less "
    "time; "
    "tight: 8 routes on a coarser roadmap, the shortest path in more time";

// Samplers have nothing that these say.
void RequireRoutesAreCompared(const PlanFlags& flags, PlannerId planner) {
  if (planner == PlannerId::kContactSurface) return;
  for (const char* flag : {"--preset", "--routes"}) {
    if (flags.app->count(flag) == 0) continue;
    const std::string contact_surface = ToString(PlannerId::kContactSurface);
    const bool is_picked = !flags.budget.empty() && flags.planner.empty();
    throw InputError(
        std::string(flag) + ": expected with planner " + contact_surface +
        ", found with " + ToString(planner) +
        (is_picked ? ", which --budget picked; add --planner " + contact_surface
                   : ""));
  }
}

// The scene as the flags change it, and what they ask beyond it.
PlanRequest RequestOf(const PlanFlags& flags, Scene* scene) {
  PlanningSettings& settings = scene->planning;
  if (!flags.budget.empty()) {
    PlanRequest by_budget;
    ApplyBudget(BudgetOf(flags.budget), scene->workspace, &by_budget);
    settings.planner = by_budget.planner;
    settings.model = by_budget.model;
    scene->preset = by_budget.preset;
  }
  if (!flags.planner.empty()) {
    settings.planner = ParsePlanner(flags.planner, "--planner");
  }
  if (!flags.model.empty()) settings.model = ParseModel(flags.model, "--model");
  RequireRoutesAreCompared(flags, settings.planner);
  SetPreset(flags.preset, scene);
  if (!flags.clearance.empty()) {
    RequireSeeksClearance(settings.planner, "--clearance");
    settings.clearance = ParseClearance(
        flags.clearance, "--clearance",
        ContactBounds(scene->workspace).Diagonal(), scene->workspace.unit);
  }
  if (!flags.time_limit.empty()) {
    settings.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  PlanRequest request = PlanRequestOf(*scene);
  request.routes = flags.routes;
  request.retraction = ParseRetraction(flags.metric, "--metric");
  request.requires_clearance = flags.require;
  request.verifies = flags.verify;
  return request;
}

// `explored`: by the last run; none where the straight way was enough.
View PageOf(const Scene& scene, const World& world, const PlanRequest& request,
            std::optional<ExploredSpace> explored) {
  if (!PlansInWindow(world, request)) {
    return SceneView(
        scene, {VisibleMesh(world.Sealed(), PlanningRegion(world, request))});
  }
  if (request.planner != PlannerId::kContactSurface) {
    return WindowView(scene, world);
  }
  if (!explored) explored = Plan(world, request).evidence.surface;
  return explored
             ? ExploredView(scene, VisibleMesh(explored->AsContactSpace(),
                                               PlanningRegion(world, request)))
             : SceneView(scene);
}

// What the model made of the run, on stderr.
void TellPlanModel(const PlanRequest& request, const PathAnswer& answer) {
  const PathEvidence& evidence = answer.evidence;
  if (evidence.model != Model::kWindow) return;
  const std::string planner = ToString(request.planner);
  std::string text = "model window: free space alone";
  if (!evidence.refusal.empty()) text += ", as the whole is refused";
  text += request.model == Model::kAuto && evidence.refusal.empty()
              ? ", which is enough for " + planner
              : ", by " + planner;
  if (const auto boxes = answer.plan->explored_boxes) {
    text += *boxes == 0 ? ", which took the straight way"
                        : ", which built of the contact space " +
                              std::to_string(*boxes) + " boxes";
  }
  Note(text + (evidence.refusal.empty() ? "" : ": " + evidence.refusal));
}

// What flags ask of each other.
void CheckPlanFlags(const PlanFlags& flags, const PlanRequest& request) {
  if (!flags.ompl_log.empty() &&
      request.planner == PlannerId::kContactSurface) {
    throw InputError("--ompl-log: expected a planner of OMPL, found " +
                     std::string(ToString(request.planner)));
  }
  if (flags.app->count("--threads") > 0) {
    throw InputError(
        "--threads: expected with a robot that turns, found one that only "
        "translates");
  }
  if (flags.require && !request.clearance) {
    throw InputError("--require: expected --clearance, found none");
  }
}

int AnswerPlan(const PlanFlags& flags) {
  RequireRuns(flags.runs);
  const SceneSource source(flags.scene, flags.root,
                           ParseRepair(flags.repair, "--repair"));
  if (source.turns()) return AnswerRigidPlan(flags, source);
  Scene scene = source.Load();
  PlanRequest request = RequestOf(flags, &scene);
  CheckPlanFlags(flags, request);
  const bool has_log = !flags.ompl_log.empty();
  SeededRuns runs(flags, source,
                  "scene, planner, seed: status, seconds (without contact "
                  "space), points, length, clearance (user's unit)",
                  SummarizeKeptPlan);
  if (has_log) runs.outputs().Declare(flags.ompl_log);
  SilenceOmpl();
  const World world(scene.workspace, scene.name, UserCache(flags.no_cache),
                    flags.limits);
  TellAbout(scene);
  const std::string beyond = ClearanceBeyondReach(world, request);
  if (!beyond.empty()) Warn(beyond);
  std::string refuted;
  // The last run may be one that was kept from before: it has no surface.
  std::optional<ExploredSpace> explored;
  for (int i = runs.kept(); i < flags.runs; ++i) {
    request.seed = flags.seed + static_cast<std::uint64_t>(i);
    ProgressOf("runs", static_cast<std::size_t>(i - runs.kept()),
               static_cast<std::size_t>(flags.runs - runs.kept()));
    Progress("run " + std::to_string(i + 1) + " of " +
             std::to_string(flags.runs));
    const PathAnswer answer = Plan(world, request);
    if (i == runs.kept()) TellPlanModel(request, answer);
    if (i == runs.kept() && flags.explain) {
      TellExplanation(ExplainPlan(*flags.app, world, request, answer));
    }
    if (answer.status == PathStatus::kVerificationFailed && refuted.empty()) {
      refuted = scene.name + ": " + answer.reason;
    }
    explored = answer.evidence.surface;
    runs.Add(
        SummarizePlan(scene, request, answer),
        PlanRow(scene, world, request, answer),
        runs.ShowsBehind() ? BehindPlan(world, request, answer) : ViewBehind());
  }
  runs.Write(
      [&] { return PageOf(scene, world, request, std::move(explored)); });
  const WorldSpaces* built = world.Built(SpaceLayout::kSealed);
  TellAboutSpaces(world, built == nullptr ? 0 : built->triangles);
  if (has_log) {
    Progress("running OMPL's benchmark");
    request.seed = flags.seed + static_cast<std::uint64_t>(flags.runs) - 1;
    runs.outputs().Write(flags.ompl_log, OmplLog(world, request, flags.runs));
  }
  const int code = runs.Commit();
  if (!refuted.empty()) FailVerification(refuted);
  return code;
}

void AddClearance(CLI::App* app, PlanFlags* flags) {
  app->add_option("--clearance", flags->clearance,
                  "To seek where there is room, more than 0 and at most D, the "
                  "diagonal of the obstacles' contact space: 0.01 or 0.01D is "
                  "a share of D, 0.5unit is in the scene's unit; a share "
                  "above 0.1 has to say D; where the scene's unit has a name, "
                  "20mm and 20 are in it (scene's own if not set)")
      ->type_name("LENGTH");
  app->add_flag("--require", flags->require,
                "Less than the clearance is no answer: status "
                "clearance_missed, exit code 1");
}

}  // namespace

Command AddPlan(CLI::App* app) {
  auto flags = std::make_shared<PlanFlags>();
  AddScene(app, flags.get());
  AddBudget(app, "planner, model and preset", &flags->budget);
  AddPreset(app, kPlanPresetHelp, &flags->preset);
  app->add_option("--planner", flags->planner,
                  "contact-surface is complete, deterministic and proves "
                  "infeasibility; the others sample (scene's own if not set, "
                  "or contact-surface)")
      ->check(CLI::IsMember(PlannerNames()));
  app->add_option(
         "--metric", flags->metric,
         "How retraction planners carry colliding samples to the "
         "contact space: along all Phong branches, one of them, to "
         "the nearest point (euclidean), to every point nearest "
         "within its surroundings (euclidean-all), or to a random one, "
         "or as many as there are Phong branches (contact-points)")
      ->check(CLI::IsMember(RetractionNames()))
      ->capture_default_str();
  AddModel(app, "plan",
           "as exact, for planners that only check motions, with what leads "
           "from start to goal of the contact space for contact-surface",
           &flags->model);
  app->add_option("--routes", flags->routes,
                  "Ways of different kinds that contact-surface compares "
                  "(preset's own if not set)")
      ->check(Between(1, 1000))
      ->type_name("N");
  AddBuildLimits(app, &flags->limits.max_seconds, &flags->limits.max_mib);
  AddClearance(app, flags.get());
  app->add_option("--time", flags->time_limit,
                  "Limit of a run by a sampler, seconds (scene's own if not "
                  "set)")
      ->transform(SecondsAboveZero())
      ->type_name("S");
  AddRuns(app, "Of the first run", flags.get());
  app->add_option("--threads", flags->threads,
                  "Of a robot that turns: so many searches race, each on a "
                  "thread and with random numbers of its own")
      ->check(Between(1, 64))
      ->type_name("N")
      ->capture_default_str();
  AddRowOutput(app, flags.get());
  app->add_option("--ompl-log", flags->ompl_log,
                  "Also run OMPL's own benchmark on the planner and write its "
                  "log, which OMPL's statistics script reads")
      ->type_name("FILE");
  AddPictures(app, flags.get());
  AddExplain(app, &flags->explain);
  AddVerify(app, &flags->verify);
  AddNoCache(app, &flags->no_cache);
  AddExamples(
      app, {"phongpd plan tunnel:delta=0.001",
            "phongpd plan scene.json --clearance 2unit --output plan.jsonl "
            "--html plan.html",
            "phongpd plan knot --model window --planner rrt-connect --runs 5 "
            "--json"});
  return [flags] { return AnswerPlan(*flags); };
}

}  // namespace phongpd::cli
