// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/solid/solid.h"
#include "problems/cli/obstacle_depths.h"
#include "problems/cli/run_path.h"
#include "problems/cli/scene_solver.h"
#include "problems/cli/solve_question.h"
#include "problems/output/rigid_row.h"
#include "viewer/rigid_view.h"
#include "viewer/view_entries.h"

namespace phongpd::cli {
namespace {

using TurningJson = nlohmann::ordered_json;

// Around robot and obstacles, wherever the scene begins and ends.
BoundingBox RoomOf(const TurningScene& scene) {
  BoundingBox room = ComputeBounds(scene.robot);
  for (const TurningScene::Obstacle& obstacle : scene.obstacles) {
    const BoundingBox own = ComputeBounds(obstacle.mesh);
    room = {room.min.cwiseMin(own.min), room.max.cwiseMax(own.max)};
  }
  return room;
}

// Of a robot that turns as it moves.
class OneTurningSolver : public SceneSolver {
 public:
  OneTurningSolver(const TurningScene& scene, double seconds)
      : scene_(scene), world_(RigidWorldOf(scene)), seconds_(seconds) {
    scene_.time_limit = std::min(scene_.time_limit, SearchSeconds(seconds));
  }

  TurningJson Answer(const std::string& text,
                     const std::function<bool()>& is_cancelled) override {
    const SolveQuestion question =
        ReadQuestion(text, {TaskKind::kTurns, RoomOf(scene_), {}});
    TurningJson answer = {{"what", ToString(question.what)}};
    if (question.what == QuestionKind::kDepth) {
      if (depths_.empty()) depths_ = Depths();
      answer.update(depths_.At(question.start));
      return answer;
    }
    RigidRequest request = RigidRequestOf(scene_);
    request.start = question.start;
    request.goal = question.goal;
    request.seed = question.Seed().value_or(request.seed);
    request.is_interrupted = is_cancelled;
    answer.update(question.what == QuestionKind::kPlan
                      ? AnswerPlan(request)
                      : AnswerOptimize(request));
    return answer;
  }

 private:
  TurningJson AnswerPlan(const RigidRequest& request) const {
    const RigidAnswer found = Plan(world_, request);
    return {{"row", RigidRow(scene_, request, found)},
            {"paths", {PathEntry(NamedPathOf(request, found))}}};
  }

  TurningJson AnswerOptimize(const RigidRequest& task) const {
    RigidOptimizeRequest request;
    request.task = task;
    const RigidOptimum found = Optimize(world_, request);
    return {{"row", RigidOptimumRow(scene_, request, found)},
            {"paths", {PathEntry(NamedPathOf(task, found.answer))}}};
  }

  // Of solids alone; surfaces that are none are refused by their names.
  ObstacleDepths Depths() const {
    std::vector<Solid> obstacles;
    for (const TurningScene::Obstacle& obstacle : scene_.obstacles) {
      obstacles.push_back(MakeSolid(obstacle.mesh, obstacle.name));
    }
    return {MakeSolid(scene_.robot, "robot"), obstacles, seconds_};
  }

  TurningScene scene_;
  RigidWorld world_;
  double seconds_;
  ObstacleDepths depths_;  // from the first on
};

}  // namespace

std::unique_ptr<SceneSolver> TurningSolver(const TurningScene& scene,
                                           double seconds) {
  return std::make_unique<OneTurningSolver>(scene, seconds);
}

}  // namespace phongpd::cli
