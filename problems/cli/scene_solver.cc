// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/scene_solver.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "planners/ompl/ompl_planning.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/cli/end_collision.h"
#include "problems/cli/obstacle_depths.h"
#include "problems/cli/run_path.h"
#include "problems/cli/solve_question.h"
#include "problems/output/answer_row.h"
#include "problems/scenes/scene_requests.h"
#include "viewer/motion_view.h"
#include "viewer/view_entries.h"

namespace phongpd::cli {
namespace {

using SolveJson = nlohmann::ordered_json;

// Of one robot that translates.
class OneRobotSolver : public SceneSolver {
 public:
  OneRobotSolver(const Scene& scene, const ContactSpaceCache& cache,
                 double seconds)
      : scene_(scene),
        world_(scene.workspace, scene.name, cache, {seconds, 0.0}),
        seconds_(seconds) {
    SilenceOmpl();
  }

  SolveJson Answer(const std::string& text,
                   const std::function<bool()>& is_cancelled) override {
    const SolveQuestion question = ReadQuestion(
        text, {TaskKind::kTranslates, ContactBounds(world_.workspace()), {}});
    SolveJson answer = {{"what", ToString(question.what)}};
    switch (question.what) {
      case QuestionKind::kPlan:
        answer.update(AnswerPlan(question));
        break;
      case QuestionKind::kOptimize:
        answer.update(AnswerOptimize(question, is_cancelled));
        break;
      case QuestionKind::kDepth:
        answer.update(AnswerDepth(question));
        break;
    }
    return answer;
  }

 private:
  // The scene as the question changes it.
  Scene Asked(const SolveQuestion& question) const {
    Scene asked = scene_;
    asked.start = question.start.position;
    asked.goal = question.goal.position;
    asked.preset = question.GivenPreset().value_or(asked.preset);
    const SolveJson& options = question.options;
    if (options.contains("planner")) {
      asked.planning.planner =
          ParsePlanner(options["planner"].get<std::string>(), "planner");
    }
    if (options.contains("metric")) {
      asked.penetration.metric =
          ParseMetricKind(options["metric"].get<std::string>(), "metric");
    }
    asked.planning.time_limit =
        std::min(asked.planning.time_limit, SearchSeconds(seconds_));
    return asked;
  }

  void SayCollision(const SolveQuestion& question, PathStatus status,
                    SolveJson* answer) const {
    const std::string end = CollidingEnd(status);
    if (end.empty()) return;
    const RobotPose& pose = end == "start" ? question.start : question.goal;
    const std::string who =
        TrianglesThatMeet(world_.workspace(), pose.position);
    if (!who.empty()) (*answer)["collision"] = who;
  }

  SolveJson AnswerPlan(const SolveQuestion& question) const {
    const Scene asked = Asked(question);
    PlanRequest request = PlanRequestOf(asked);
    request.seed = question.Seed().value_or(request.seed);
    const PathAnswer found = Plan(world_, request);
    SolveJson answer = {{"row", PlanRow(asked, world_, request, found)},
                        {"paths", {PathEntry(NamedPathOf(request, found))}}};
    SayCollision(question, found.status, &answer);
    return answer;
  }

  SolveJson AnswerOptimize(const SolveQuestion& question,
                           const std::function<bool()>& is_cancelled) const {
    const Scene asked = Asked(question);
    OptimizeRequest request = OptimizeRequestOf(asked);
    if (request.limits && question.options.contains("metric")) {
      RefuseQuestion("/options/metric",
                     "none of a motion in time, which follows no metric",
                     question.options["metric"].dump());
    }
    request.options.seed = question.Seed().value_or(request.options.seed);
    request.options.time_limit = SearchSeconds(seconds_);
    request.is_interrupted = EndOf(seconds_, is_cancelled);
    const PathAnswer found = Optimize(world_, request);
    SolveJson answer = {
        {"row", request.limits ? MotionRow(asked, world_, request, found)
                               : PolylineRow(asked, world_, request, found)},
        {"paths",
         {PathEntry(request.limits ? PathInTime(world_, request, found)
                                   : NamedPathOf(request, found))}}};
    if (!request.moving.empty()) {
      answer["movers"] =
          MoverEntries(MoversOf(request.moving, found.motion.duration()));
    }
    SayCollision(question, found.status, &answer);
    return answer;
  }

  SolveJson AnswerDepth(const SolveQuestion& question) {
    const Workspace& solids = world_.workspace();
    if (depths_.empty()) {
      depths_ = ObstacleDepths(solids.robot, solids.obstacles, seconds_);
    }
    return depths_.At(question.start);
  }

  Scene scene_;
  World world_;
  double seconds_;
  ObstacleDepths depths_;  // from the first on
};

}  // namespace

std::unique_ptr<SceneSolver> TranslatingSolver(const Scene& scene,
                                               const ContactSpaceCache& cache,
                                               double seconds) {
  return std::make_unique<OneRobotSolver>(scene, cache, seconds);
}

std::unique_ptr<SceneSolver> SolverOf(const ServedScene& scene,
                                      const ContactSpaceCache& cache,
                                      double seconds) {
  if (const auto* turning = std::get_if<TurningScene>(&scene)) {
    return TurningSolver(*turning, seconds);
  }
  if (const auto* fleet = std::get_if<FleetScene>(&scene)) {
    return FleetSolver(*fleet, cache, seconds);
  }
  return TranslatingSolver(std::get<Scene>(scene), cache, seconds);
}

}  // namespace phongpd::cli
