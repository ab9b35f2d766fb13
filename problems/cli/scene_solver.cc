// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/scene_solver.h"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/contact/depth.h"
#include "planners/ompl/ompl_planning.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/cli/depth_row.h"
#include "problems/cli/seeded_runs.h"
#include "problems/cli/view_rows.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_requests.h"
#include "problems/studies/answer_row.h"
#include "viewer/motion_view.h"
#include "viewer/view_entries.h"

namespace phongpd::cli {
namespace {

using SolveJson = nlohmann::ordered_json;

constexpr char kQuestion[] = "question";
// Beyond this many D there is nothing to find, and numbers lose their digits.
constexpr double kFarthest = 1e6;

SolveJson QuestionSchema() {
  const SolveJson point = {{"type", "array"},
                           {"items", {{"type", "number"}}},
                           {"minItems", 3},
                           {"maxItems", 3}};
  const SolveJson options = {
      {"type", "object"},
      {"additionalProperties", false},
      {"properties",
       {{"planner", {{"enum", PlannerNames()}}},
        {"metric", {{"enum", MetricNames()}}},
        {"preset", {{"enum", PresetNames()}}},
        {"seed",
         {{"type", "integer"}, {"minimum", 0}, {"maximum", 4294967295}}}}}};
  return {{"type", "object"},
          {"additionalProperties", false},
          {"required", {"what", "start"}},
          {"properties",
           {{"what", {{"enum", {"plan", "optimize", "depth"}}}},
            {"start", point},
            {"goal", point},
            {"options", options}}}};
}

// A question that has passed the schema, and makes sense.
struct Question {
  std::string what;
  Eigen::Vector3d start, goal;
  SolveJson options;
};

[[noreturn]] void RefuseQuestion(const std::string& where,
                                 const std::string& expected,
                                 const std::string& found) {
  JsonPlace{kQuestion, where}.Fail(expected, found);
}

Eigen::Vector3d PointAt(const SolveJson& json, const std::string& key,
                        const World& world) {
  const SolveJson& cells = json.at(key);
  const Eigen::Vector3d p(cells[0].get<double>(), cells[1].get<double>(),
                          cells[2].get<double>());
  const Eigen::Vector3d middle = ContactBounds(world.workspace()).Center();
  if ((p - middle).norm() > kFarthest * world.diagonal()) {
    RefuseQuestion("/" + key, "a position within a million D of the obstacles",
                   cells.dump());
  }
  return p;
}

Question ReadQuestion(const std::string& text, const World& world) {
  const SolveJson json = ParseJson(text, kQuestion);
  RequireSchema(json, QuestionSchema(), kQuestion);
  Question question;
  question.what = json.at("what").get<std::string>();
  question.start = PointAt(json, "start", world);
  const bool is_depth = question.what == "depth";
  if (json.contains("goal") == is_depth) {
    RefuseQuestion("/goal", is_depth ? "none of a depth" : "[x, y, z]",
                   is_depth ? "one" : "none");
  }
  if (!is_depth) question.goal = PointAt(json, "goal", world);
  question.options = json.value("options", SolveJson::object());
  for (const auto& [key, value] : question.options.items()) {
    const bool is_known = key == "planner"  ? question.what == "plan"
                          : key == "metric" ? question.what == "optimize"
                                            : !is_depth;
    if (!is_known) {
      RefuseQuestion("/options/" + key, "none of " + question.what,
                     value.dump());
    }
  }
  return question;
}

// true once `seconds` have gone by.
std::function<bool()> Deadline(double seconds) {
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  return [end] { return std::chrono::steady_clock::now() > end; };
}

}  // namespace

struct SceneSolver::Impl {
  Impl(const Scene& given, const ContactSpaceCache& cache, double limit)
      : scene(given),
        world(given.workspace, given.name, cache, {limit, 0.0}),
        seconds(limit) {}

  // The scene as the question changes it.
  Scene Asked(const Question& question) const {
    Scene asked = scene;
    asked.start = question.start;
    asked.goal = question.goal;
    const SolveJson& options = question.options;
    if (options.contains("preset")) {
      asked.preset =
          ParsePreset(options["preset"].get<std::string>(), "preset");
    }
    if (options.contains("planner")) {
      asked.planning.planner =
          ParsePlanner(options["planner"].get<std::string>(), "planner");
    }
    if (options.contains("metric")) {
      asked.penetration.metric =
          ParseMetricKind(options["metric"].get<std::string>(), "metric");
    }
    asked.planning.time_limit = std::min(asked.planning.time_limit, seconds);
    return asked;
  }

  SolveJson AnswerPlan(const Question& question) const {
    const Scene asked = Asked(question);
    PlanRequest request = PlanRequestOf(asked);
    request.seed = question.options.value("seed", request.seed);
    const SolveJson row = PlanRow(asked, world, request, Plan(world, request));
    return {{"what", question.what},
            {"row", row},
            {"paths", {PathEntry(NamedPathOf(row))}}};
  }

  SolveJson AnswerOptimize(const Question& question) const {
    const Scene asked = Asked(question);
    OptimizeRequest request = OptimizeRequestOf(asked);
    if (request.limits && question.options.contains("metric")) {
      RefuseQuestion("/options/metric",
                     "none of a motion in time, which follows no metric",
                     question.options["metric"].dump());
    }
    request.options.seed = question.options.value("seed", request.options.seed);
    request.options.time_limit = seconds;
    request.is_interrupted = Deadline(seconds);
    const PathAnswer answer = Optimize(world, request);
    const SolveJson row = request.limits
                              ? MotionRow(asked, world, request, answer)
                              : PolylineRow(asked, world, request, answer);
    return {{"what", question.what},
            {"row", row},
            {"paths",
             {PathEntry(request.limits ? PathInTime(world, request, answer)
                                       : NamedPathOf(row))}}};
  }

  SolveJson AnswerDepth(const Question& question) {
    const Workspace& solids = world.workspace();
    if (depths.empty()) {
      DepthOptions options;
      options.max_seconds = seconds;
      for (const Solid& obstacle : solids.obstacles) {
        depths.emplace_back(solids.robot, obstacle, options);
      }
    }
    SolveJson rows = SolveJson::array(), answers = SolveJson::array();
    for (std::size_t i = 0; i < depths.size(); ++i) {
      RobotPose pose;
      pose.position = question.start;
      SolveJson row = DepthAnswerRow(pose, depths[i].At(pose));
      answers.push_back(AnswerEntry(DepthAnswerOf(row)));
      row["obstacle"] = solids.obstacles[i].name();
      rows.push_back(std::move(row));
    }
    return {{"what", question.what}, {"rows", rows}, {"answers", answers}};
  }

  Scene scene;
  World world;
  double seconds;
  std::vector<DepthQuery> depths;  // of each obstacle, from the first on
};

SceneSolver::SceneSolver(const Scene& scene, const ContactSpaceCache& cache,
                         double seconds)
    : impl_(std::make_unique<Impl>(scene, cache, seconds)) {
  SilenceOmpl();
}

SceneSolver::~SceneSolver() = default;

nlohmann::ordered_json SceneSolver::Answer(const std::string& text) {
  const Question question = ReadQuestion(text, impl_->world);
  if (question.what == "depth") return impl_->AnswerDepth(question);
  if (question.what == "plan") return impl_->AnswerPlan(question);
  return impl_->AnswerOptimize(question);
}

}  // namespace phongpd::cli
