// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>
#include <utility>

#include "planners/solve/fleet.h"
#include "problems/cli/end_collision.h"
#include "problems/cli/obstacle_depths.h"
#include "problems/cli/scene_solver.h"
#include "problems/cli/solve_question.h"
#include "problems/output/fleet_row.h"
#include "problems/scenes/scene_requests.h"
#include "viewer/motion_view.h"
#include "viewer/scene_view.h"
#include "viewer/view_entries.h"

namespace phongpd::cli {
namespace {

using FleetJson = nlohmann::ordered_json;

// Of several robots that translate.
class SeveralRobotsSolver : public SceneSolver {
 public:
  SeveralRobotsSolver(const FleetScene& scene, const ContactSpaceCache& cache,
                      double seconds)
      : scene_(scene),
        robots_(RobotsOf(scene, cache, {seconds, 0.0})),
        depths_(scene.robots.size()),
        seconds_(seconds) {
    for (const FleetRobot& robot : robots_) {
      const BoundingBox own = ContactBounds(robot.world.workspace());
      BoundingBox& room = scope_.room;
      room = room.IsEmpty() ? own
                            : BoundingBox{room.min.cwiseMin(own.min),
                                          room.max.cwiseMax(own.max)};
      scope_.robots.push_back(robot.name);
    }
    scope_.kind = TaskKind::kRobots;
  }

  FleetJson Answer(const std::string& text,
                   const std::function<bool()>& is_cancelled) override {
    const SolveQuestion question = ReadQuestion(text, scope_);
    FleetJson answer = {{"what", ToString(question.what)}};
    answer.update(question.what == QuestionKind::kDepth
                      ? AnswerDepth(question)
                      : AnswerOptimize(question, is_cancelled));
    return answer;
  }

 private:
  // The scene as the question changes it, and its robots.
  FleetScene Asked(const SolveQuestion& question) const {
    FleetScene asked = scene_;
    for (Scene& robot : asked.robots) {
      robot.preset = question.GivenPreset().value_or(robot.preset);
    }
    for (const SolveQuestion::Robot& robot : question.robots) {
      asked.robots[robot.index].start = robot.start;
      asked.robots[robot.index].goal = robot.goal;
    }
    return asked;
  }

  std::vector<FleetRobot> RobotsOfScene(
      const FleetScene& asked, const SolveQuestion& question,
      const std::function<bool()>& is_cancelled) const {
    std::vector<FleetRobot> robots = robots_;
    const std::function<bool()> is_over = EndOf(seconds_, is_cancelled);
    for (std::size_t i = 0; i < robots.size(); ++i) {
      OptimizeRequest& request = robots[i].request;
      request = OptimizeRequestOf(asked.robots[i]);
      request.options.seed = question.Seed().value_or(request.options.seed);
      request.options.time_limit = SearchSeconds(seconds_);
      request.is_interrupted = is_over;
    }
    return robots;
  }

  FleetJson AnswerOptimize(const SolveQuestion& question,
                           const std::function<bool()>& is_cancelled) const {
    const FleetScene asked = Asked(question);
    const std::vector<FleetRobot> robots =
        RobotsOfScene(asked, question, is_cancelled);
    RequireFleet(robots);
    const FleetAnswer found = OptimizeFleet(robots);
    View view = FleetSceneView(asked);
    AddFleet(robots, found, &view);
    FleetJson answer = {{"row", FleetRow(asked, robots, found)},
                        {"paths", FleetJson::array()},
                        {"movers", MoverEntries(view.movers)}};
    for (const NamedPath& path : view.paths) {
      answer["paths"].push_back(PathEntry(path));
    }
    if (const FleetPair* closest = found.Closest()) {
      answer["closest"] = ClosestText(*closest, view.unit);
    }
    for (std::size_t i = 0; i < found.robots.size(); ++i) {
      const std::string end = CollidingEnd(found.robots[i].status);
      if (end.empty()) continue;
      const Scene& robot = asked.robots[i];
      const std::string who = TrianglesThatMeet(
          robot.workspace, end == "start" ? robot.start : robot.goal);
      if (!who.empty()) answer["collision"] = robots[i].name + ": " + who;
    }
    return answer;
  }

  FleetJson AnswerDepth(const SolveQuestion& question) {
    ObstacleDepths& depths = depths_[question.robot];
    if (depths.empty()) {
      const Workspace& solids = scene_.robots[question.robot].workspace;
      depths = ObstacleDepths(solids.robot, solids.obstacles, seconds_);
    }
    return depths.At(question.start);
  }

  FleetScene scene_;
  std::vector<FleetRobot> robots_;      // whose worlds are kept
  std::vector<ObstacleDepths> depths_;  // of each robot, from its first on
  QuestionScope scope_;
  double seconds_;
};

}  // namespace

std::unique_ptr<SceneSolver> FleetSolver(const FleetScene& scene,
                                         const ContactSpaceCache& cache,
                                         double seconds) {
  return std::make_unique<SeveralRobotsSolver>(scene, cache, seconds);
}

}  // namespace phongpd::cli
