// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/src/workshop.h"

#include <nlohmann/json.hpp>

#include "planners/world/bare_length.h"
#include "problems/studies/planning_study.h"
#include "problems/studies/timed_trajectory.h"
#include "python/src/interruptible.h"

namespace phongpd::python {

using Eigen::Vector3d;

ContactSpaceCache FolderOf(bool cache) {
  ContactSpaceCache folder;
  if (cache) folder.directory = DefaultCacheDirectory();
  return folder;
}

Workshop::Workshop(const Scene& scene, bool cache, double max_mib)
    : scene_(scene),
      cache_(FolderOf(cache)),
      world_(scene.workspace, scene.name, cache_, {0.0, max_mib}),
      trajectories_(cache_) {}

const WorldSpaces& Workshop::Spaces() const {
  if (!is_built_) {
    Interruptible([&] {
      world_.Spaces(SpaceLayout::kMerged);
      return true;
    });
    is_built_ = true;
  }
  return world_.Spaces(SpaceLayout::kMerged);
}

std::string Workshop::Optimize(const Point& start, const Point& goal,
                               const std::string& metric,
                               const std::string& margin, int waypoints,
                               std::uint64_t seed, double max_seconds,
                               bool is_straight, const std::string& preset,
                               const std::string& model, bool is_required) {
  return Interruptible([&] {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    Scene scene = Between(start, goal);
    if (!margin.empty()) {
      scene.trajectory.margin =
          ParseClearance(margin, "margin", world_.diagonal(), scene.unit);
    }
    if (waypoints > 0) scene.trajectory.waypoints = waypoints;
    if (!preset.empty()) scene.preset = ParsePreset(preset, "preset");
    if (!model.empty()) scene.trajectory.model = model;
    // Whoever names a metric is told that it cannot be followed.
    if (model.empty() && scene.trajectory.model == "auto") {
      scene.trajectory.model = "full";
    }
    if (!metric.empty() && scene.trajectory.model == "window") {
      throw InputError(
          "metric: expected none with model window, which follows no metric, "
          "found " +
          metric);
    }
    PipelineOptions options = ScenePipelineOptions(scene);
    options.seed = seed;
    options.time_limit = max_seconds;
    if (is_straight) options.start = TrajectoryStart::kStraight;
    trajectories_.Enter(scene, world_);
    const TrajectoryMetric chosen =
        metric.empty() ? SceneMetric(scene)
                       : ParseTrajectoryMetric(metric, "metric");
    const PipelineResult result = trajectories_.Run(chosen, options);
    nlohmann::ordered_json row =
        TrajectoryRow(trajectories_, chosen, options, result);
    return Judged(scene, ClaimsOf(result),
                  WishOfTrajectory(scene, !margin.empty(), is_required), &row);
  });
}

template <typename Ask>
std::string Workshop::InTime(Scene scene, const MotionWishes& wishes,
                             const std::atomic<bool>& is_asked,
                             const Ask& ask) {
  const bool has_margin = !wishes.margin.empty();
  if (has_margin) {
    scene.trajectory.margin =
        ParseClearance(wishes.margin, "margin", world_.diagonal(), scene.unit);
  }
  if (!wishes.preset.empty()) {
    scene.preset = ParsePreset(wishes.preset, "preset");
  }
  scene.duration = wishes.duration;
  scene.via.clear();
  for (const auto& [point, tolerance, dwell] : wishes.via) {
    SceneVia via;
    via.point = ToVector(point);
    via.dwell = dwell;
    if (!tolerance.empty()) {
      via.tolerance = ParseLength(tolerance, "tolerance", scene.unit);
      RequireLength(via.tolerance, LengthRange::kAboveZero, world_.diagonal(),
                    "tolerance", scene.unit);
    }
    scene.via.push_back(via);
  }
  const MotionLimits limits = {ToVector(wishes.limits[0]),
                               ToVector(wishes.limits[1]),
                               ToVector(wishes.limits[2])};
  CurveOptions options = SceneCurveOptions(scene, world_, limits);
  options.time_limit = wishes.max_seconds;
  options.is_interrupted = [&is_asked] { return is_asked.load(); };
  const TimedTrajectory timed = ask(scene, options);
  nlohmann::ordered_json row = TimedRow(scene, world_, options, timed);
  return Judged(scene, ClaimsOf(timed),
                WishOfTrajectory(scene, has_margin, wishes.is_required), &row);
}

std::string Workshop::OptimizeInTime(const Point& start, const Point& goal,
                                     const std::string& model,
                                     const MotionWishes& wishes) {
  return Interruptible([&](const std::atomic<bool>& is_asked) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    Scene scene = Between(start, goal);
    if (!model.empty()) scene.trajectory.model = model;
    return InTime(scene, wishes, is_asked,
                  [&](const Scene& asked, const CurveOptions& options) {
                    return PlanInTime(asked, world_, options);
                  });
  });
}

std::string Workshop::Retime(const std::vector<Point>& path,
                             const MotionWishes& wishes) {
  return Interruptible([&](const std::atomic<bool>& is_asked) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    std::vector<Vector3d> points;
    for (const Point& p : path) points.push_back(ToVector(p));
    return InTime(Between(path.front(), path.back()), wishes, is_asked,
                  [&](const Scene&, const CurveOptions& options) {
                    return TimePath(world_, points, options);
                  });
  });
}

std::string Workshop::Plan(const Point& start, const Point& goal,
                           const std::string& planner,
                           const std::string& retraction,
                           const std::string& clearance, double max_seconds,
                           std::uint64_t seed, const std::string& preset,
                           const std::string& model, bool is_required) {
  return Interruptible([&] {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    Scene scene = Between(start, goal);
    if (!clearance.empty()) {
      RequireSeeksClearance(planner, "clearance");
      scene.planning.clearance =
          ParseClearance(clearance, "clearance", world_.diagonal(), scene.unit);
    }
    if (!preset.empty()) {
      if (planner != kContactSurface) {
        throw InputError(std::string("preset: expected with planner ") +
                         kContactSurface + ", found with " + planner);
      }
      scene.preset = ParsePreset(preset, "preset");
    }
    if (!model.empty()) scene.planning.model = model;
    const ClearanceWish wish = WishOfPlan(scene, is_required);
    if (is_required && !wish.asked) {
      throw InputError("require: expected a clearance with it, found none");
    }
    PlanningStudy study(scene, world_);
    PlanningRun run;
    run.planner = planner;
    run.retraction = retraction;
    run.time_limit = max_seconds;
    run.seed = seed;
    const PlanningResult result = study.Run(run);
    nlohmann::ordered_json row = PlanningRow(study, run, result);
    return Judged(scene, ClaimsOf(result), wish, &row);
  });
}

Scene Workshop::Between(const Point& start, const Point& goal) const {
  Scene scene = scene_;
  scene.start = ToVector(start);
  scene.goal = ToVector(goal);
  for (const Vector3d& q : {scene.start, scene.goal}) {
    if (q.allFinite()) continue;
    throw InputError("start and goal: expected finite numbers, found others");
  }
  scene.witness.clear();
  scene.feasible.reset();
  return scene;
}

std::string Workshop::Judged(const Scene& scene, const AnswerClaims& claims,
                             const ClearanceWish& wish,
                             nlohmann::ordered_json* row) const {
  AnswerCheck check(true);
  check.Judge(scene, world_, claims, row);
  check.RequireNoFailure();
  TellClearance(world_, scene, wish, row);
  return row->dump();
}

}  // namespace phongpd::python
