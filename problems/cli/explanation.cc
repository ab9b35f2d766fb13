// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/explanation.h"

#include <algorithm>

#include "core/mesh/counted.h"
#include "core/number_text.h"
#include "planners/retraction/retraction_names.h"
#include "planners/world/budget.h"
#include "problems/cli/command.h"

namespace phongpd::cli {
namespace {

using Lines = std::vector<std::string>;

bool HasBudget(const CLI::App& app) { return app.count("--budget") > 0; }

// The cell that was taken, of what was measured.
void AddBudgetLine(const CLI::App& app, BudgetUse use, const World& world,
                   Lines* lines) {
  if (!HasBudget(app)) return;
  const std::size_t triangles = TrianglesOf(world.workspace());
  const BudgetChoice& choice =
      ChoiceFor(use, triangles, app.get_option("--budget")->as<double>());
  lines->push_back("budget: " + ToString(choice.flags) + ", for " +
                   std::to_string(triangles) +
                   " triangles by the cell of about " +
                   std::to_string(choice.triangles) + " and " +
                   FormatDouble(choice.seconds) + " s, where it answered " +
                   std::to_string(choice.answered) + " of " +
                   std::to_string(choice.problems) +
                   " problems in time (results/trade/budget.md)");
}

// Who chose.  A scene that says what nobody's choice would be says nothing.
std::string Whose(const CLI::App& app, const char* flag, bool is_default) {
  if (app.count(flag) > 0) return std::string("by ") + flag;
  // A plan's --metric is another one, of samples, which no budget picks.
  const bool is_picked =
      HasBudget(app) &&
      (flag == std::string("--preset") || flag == std::string("--model") ||
       flag == std::string("--planner") ||
       (flag == std::string("--metric") && app.get_name() == "optimize"));
  if (is_picked) return "by --budget";
  return is_default ? "nobody asked for another" : "by the scene";
}

// "0.01 D = 0.035mm".
std::string InBoth(const World& world, const Length& length) {
  const std::string& unit = world.workspace().unit;
  const ResolvedLength both = world.Resolve(length);
  return Rounded(both.share) + " D = " + Rounded(both.unit) +
         (unit.empty() ? "unit" : unit);
}

std::string WorldLine(const World& world) {
  const Workspace& workspace = world.workspace();
  const std::string& unit = workspace.unit;
  return "world: D = " + Rounded(world.diagonal()) +
         (unit.empty() ? "unit" : unit) +
         ", the diagonal of the box around the contact space of " +
         std::to_string(ReachableObstacles(workspace).size()) + " of " +
         Counted(workspace.obstacles.size(), "obstacle") + "; " +
         (workspace.bounds.IsEmpty() ? "no bounds" : "within bounds");
}

// `needs_all` says for what kAuto builds all there is.
std::string ModelLine(const CLI::App& app, Model asked,
                      const PathEvidence& evidence,
                      const std::string& needs_all,
                      const std::string& is_enough,
                      const std::string& in_window = "free space alone") {
  if (!evidence.model) return "model: none, nothing had to be built";
  const bool is_window = *evidence.model == Model::kWindow;
  std::string text = is_window ? "model: window, " + in_window + " ("
                               : "model: full, the whole contact space (";
  if (asked != Model::kAuto) {
    text += Whose(app, "--model", false);
  } else if (!evidence.refusal.empty()) {
    text += "the whole is refused: " + evidence.refusal;
  } else {
    text += "auto: " + (is_window ? is_enough : needs_all);
  }
  return text + ")";
}

std::string JudgeLine(const PathAnswer& answer) {
  std::string text = "answer: " + std::string(ToString(answer.status));
  if (!answer.path.empty() || !answer.motion.empty()) {
    text += answer.is_free ? ", free by the exact judge"
                           : ", not free by the exact judge";
  }
  const auto& second = answer.evidence.verification;
  if (!second) return text + "; not judged a second time";
  return text + "; on the original solids " + ToString(second->verdict) +
         " by " + Counted(static_cast<std::size_t>(second->tests), "test");
}

std::string RoutesText(int routes) {
  return Counted(static_cast<std::size_t>(routes), "route");
}

std::string PresetLine(const CLI::App& app, Preset preset,
                       const std::string& what) {
  return std::string("preset: ") + ToString(preset) + " (" +
         Whose(app, "--preset", preset == Preset::kBalanced) + "): " + what;
}

std::string MetricLine(const CLI::App& app, const World& world,
                       const OptimizeRequest& request, bool is_window) {
  if (is_window) {
    return "metric: none, as without the contact space there is no depth to "
           "follow";
  }
  const PenetrationSpec& spec = request.penetration;
  const bool is_phong = spec.metric == MetricKind::kPhong;
  std::string text = std::string("metric: ") + ToString(spec.metric) + " (" +
                     Whose(app, "--metric", is_phong) + ")";
  if (!is_phong) return text;
  const bool is_default =
      spec.smoothing_length == PenetrationSpec().smoothing_length;
  return text + ", smoothing length " + InBoth(world, spec.smoothing_length) +
         " (" + Whose(app, "--smoothing-length", is_default) +
         "), derivative: " + ToString(spec.jacobian);
}

std::string MarginLine(const CLI::App& app, const World& world,
                       const OptimizeRequest& request) {
  return "margin: " + InBoth(world, request.Margin()) +
         ", kept where there is "
         "room (" +
         Whose(app, "--margin", !request.margin) + ")";
}

// "start repaired, ipopt converged, corridor converged".
std::string StagesLine(const PathAnswer& answer) {
  if (!answer.pipeline || answer.pipeline->stages.empty()) {
    return "stages: none ran";
  }
  std::string text = "stages:";
  for (const StageRecord& stage : answer.pipeline->stages) {
    text += (text.back() == ':' ? " " : ", ") + stage.stage + " " +
            stage.status + (stage.is_free ? " (free)" : " (not free)");
  }
  return text + "; the best of them by clearance, then energy";
}

std::string LimitsLine(const CLI::App& app, const OptimizeRequest& request,
                       const PathAnswer& answer) {
  const MotionLimits& limits = *request.limits;
  const LimitUse& use = answer.evidence.use;
  const auto percent = [](double share) {
    return Rounded(100.0 * share) + " %";
  };
  return "limits: velocity " + FormatPoint(limits.velocity) +
         ", acceleration " + FormatPoint(limits.acceleration) + ", jerk " +
         FormatPoint(limits.jerk) +
         (limits.by_norm ? ", of the norm (" : ", of each axis (") +
         Whose(app, "--limits", false) + "); the motion takes " +
         percent(use.velocity) + ", " + percent(use.acceleration) + " and " +
         percent(use.jerk) + " of them";
}

}  // namespace

void AddExplain(CLI::App* app, bool* explain) {
  app->add_flag("--explain", *explain,
                "Tell on standard error what was taken and why, of the first "
                "run: preset, planner, model, metric and lengths, a line each");
}

Lines ExplainPlan(const CLI::App& app, const World& world,
                  const PlanRequest& request, const PathAnswer& answer) {
  const bool is_surface = request.planner == PlannerId::kContactSurface;
  const std::string planner = ToString(request.planner);
  Lines lines = {WorldLine(world)};
  AddBudgetLine(app, BudgetUse::kPlan, world, &lines);
  if (is_surface) {
    ContactSurfaceOptions options;
    ApplyPreset(request.preset, &options);
    const int routes = request.routes > 0 ? request.routes : options.routes;
    lines.push_back(PresetLine(app, request.preset,
                               RoutesText(routes) + " compared at most"));
  }
  lines.push_back(
      "planner: " + planner + " (" + Whose(app, "--planner", is_surface) +
      "): " +
      (is_surface ? "complete, deterministic, proves where there is no path"
                  : "samples, seed " + std::to_string(request.seed) +
                        ", at most " + Rounded(request.time_limit) + " s (" +
                        Whose(app, "--time",
                              request.time_limit == PlanRequest().time_limit) +
                        ")"));
  lines.push_back(ModelLine(app, request.model, answer.evidence,
                            ChecksMotionsOnly(request.planner)
                                ? "it was built already"
                                : planner + " needs it, no limit refused it",
                            planner + " only asks whether motions are free"));
  if (Retracts(request.planner)) {
    lines.push_back("metric: " + RetractionName(request.retraction) + " (" +
                    Whose(app, "--metric", true) +
                    "): how colliding samples are carried to the surface");
  }
  if (request.clearance) {
    lines.push_back("clearance: " + InBoth(world, *request.clearance) +
                    ", sought where there is room (" +
                    Whose(app, "--clearance", false) + ")");
  } else {
    lines.push_back(SeeksClearance(request.planner)
                        ? "clearance: the planner's own, 0.01 of the diagonal "
                          "of what it plans in (nobody asked for another)"
                        : "clearance: none, " + planner + " seeks none");
  }
  lines.push_back(JudgeLine(answer));
  return lines;
}

Lines ExplainTrajectory(const CLI::App& app, const World& world,
                        const OptimizeRequest& request,
                        const PathAnswer& answer) {
  const bool is_motion = request.limits.has_value();
  const bool is_window = answer.evidence.model == Model::kWindow;
  std::string effort = RoutesText(request.options.routes);
  if (!is_motion) {
    effort += request.options.also_line ? ", and the line where it collides"
                                        : ", without the colliding line";
  }
  Lines lines = {WorldLine(world)};
  AddBudgetLine(app, BudgetUse::kOptimize, world, &lines);
  lines.push_back(PresetLine(app, request.preset, effort));
  lines.push_back(ModelLine(
      app, request.model, answer.evidence,
      is_motion ? "its first path walks on it, no limit refused it"
                : "a metric leads out of collisions, no limit refused it",
      "free space is all that is asked for",
      answer.windows ? "boxes of the contact space that the metric asks for"
                     : "free space alone"));
  if (is_motion) {
    lines.push_back(LimitsLine(app, request, answer));
    lines.push_back(
        "task: " + Counted(request.via.size(), "place") + " on the way, " +
        (request.duration > 0.0 ? Rounded(request.duration) + " s as asked for"
                                : "as few seconds as are found"));
  } else {
    lines.push_back(
        MetricLine(app, world, request, is_window && !answer.windows));
  }
  lines.push_back(MarginLine(app, world, request));
  if (!is_motion) lines.push_back(StagesLine(answer));
  lines.push_back(JudgeLine(answer));
  return lines;
}

Lines ExplainFleet(const CLI::App& app, const std::vector<FleetRobot>& robots,
                   const FleetAnswer& answer) {
  std::vector<Lines> each;
  for (std::size_t i = 0; i < answer.robots.size(); ++i) {
    each.push_back(ExplainTrajectory(app, robots[i].world, robots[i].request,
                                     answer.robots[i]));
  }
  const auto have_all = [&](const std::string& line) {
    return std::all_of(each.begin(), each.end(), [&](const Lines& lines) {
      return std::find(lines.begin(), lines.end(), line) != lines.end();
    });
  };
  Lines common, own;
  for (std::size_t i = 0; i < each.size(); ++i) {
    for (const std::string& line : each[i]) {
      if (!have_all(line)) {
        own.push_back(robots[i].name + ": " + line);
      } else if (i == 0) {
        common.push_back(line);
      }
    }
  }
  common.insert(common.end(), own.begin(), own.end());
  return common;
}

void TellExplanation(const Lines& lines) {
  for (const std::string& line : lines) Note(line);
}

}  // namespace phongpd::cli
