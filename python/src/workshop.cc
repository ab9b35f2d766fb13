// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/src/workshop.h"

#include <stdexcept>

#include "core/mesh/mesh_error.h"
#include "planners/world/bare_length.h"
#include "problems/output/answer_row.h"
#include "problems/scenes/scene_requests.h"
#include "python/src/interruptible.h"

namespace phongpd::python {

using Eigen::Vector3d;

namespace {

// A wrong answer is a fault of the library.
void RequireVerified(const PathAnswer& answer) {
  if (answer.status != PathStatus::kVerificationFailed) return;
  throw std::runtime_error("verification on the original solids failed: " +
                           answer.reason);
}

CurveEnd EndOf(const std::array<Point, 2>& end) {
  return {ToVector(end[0]), ToVector(end[1])};
}

}  // namespace

ContactSpaceCache FolderOf(bool cache) {
  ContactSpaceCache folder;
  if (cache) folder.directory = DefaultCacheDirectory();
  return folder;
}

Workshop::Workshop(const Scene& scene, bool cache, double max_mib)
    : scene_(scene),
      world_(scene.workspace, scene.name, FolderOf(cache), {0.0, max_mib}) {}

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

Length Workshop::Clearance(const std::string& text,
                           const std::string& what) const {
  return ParseClearance(text, what, world_.diagonal(), scene_.workspace.unit);
}

PlanRequest Workshop::PlanBetween(const Point& start, const Point& goal) const {
  return PlanRequestOf(Between(start, goal));
}

std::vector<MovingObstacle> MovingObstaclesOf(const std::vector<Moving>& moving,
                                              double* moved) {
  std::vector<MovingObstacle> obstacles;
  *moved = 0.0;
  for (const auto& [name, solid, durations, points] : moving) {
    try {
      double by = 0.0;
      obstacles.push_back(
          {solid.Named(name), JoinedCurve(durations, points, &by)});
      *moved = std::max(*moved, by);
    } catch (const InputError& error) {
      throw InputError("moving: " + name + ": " + error.what());
    }
  }
  return obstacles;
}

void AddMoving(const std::vector<Moving>& moving, OptimizeRequest* request) {
  if (moving.empty()) return;
  double moved = 0.0;  // rounding alone: no motion is known better
  request->moving = MovingObstaclesOf(moving, &moved);
}

OptimizeRequest Workshop::OptimizeBetween(const Point& start,
                                          const Point& goal) const {
  OptimizeRequest request = OptimizeRequestOf(Between(start, goal));
  request.limits.reset();
  return request;
}

OptimizeRequest Workshop::MotionBetween(const Point& start, const Point& goal,
                                        const MotionWishes& wishes) const {
  OptimizeRequest request = OptimizeBetween(start, goal);
  request.limits.emplace();
  request.limits->velocity = ToVector(wishes.limits[0]);
  request.limits->acceleration = ToVector(wishes.limits[1]);
  request.limits->jerk = ToVector(wishes.limits[2]);
  request.limits->by_norm = wishes.by_norm;
  if (!wishes.margin.empty()) {
    request.margin = Clearance(wishes.margin, "margin");
  }
  if (!wishes.preset.empty()) {
    ApplyPreset(ParsePreset(wishes.preset, "preset"), &request);
  }
  request.duration = wishes.duration;
  request.via.clear();
  const std::string& unit = scene_.workspace.unit;
  for (const auto& [point, tolerance, dwell] : wishes.via) {
    Via via;
    via.point = ToVector(point);
    via.dwell = dwell;
    if (!tolerance.empty()) {
      via.tolerance = ParseLength(tolerance, "tolerance", unit);
      RequireLength(via.tolerance, LengthRange::kAboveZero, world_.diagonal(),
                    "tolerance", unit);
    }
    request.via.push_back(via);
  }
  request.departure = EndOf(wishes.departure);
  request.arrival = EndOf(wishes.arrival);
  if (wishes.routes > 0) request.options.routes = wishes.routes;
  request.requires_margin = wishes.is_required;
  request.options.time_limit = wishes.max_seconds;
  return request;
}

AnswerAndRow Workshop::Plan(const PlanRequest& request) {
  return Interruptible([&] {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    AnswerAndRow both{phongpd::Plan(world_, request), {}};
    RequireVerified(both.answer);
    both.row = PlanRow(scene_, world_, request, both.answer);
    return both;
  });
}

AnswerAndRow Workshop::Optimize(const OptimizeRequest& request) {
  return Interruptible([&](const std::atomic<bool>& is_asked) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    OptimizeRequest asked = request;
    asked.is_interrupted = [&is_asked] { return is_asked.load(); };
    AnswerAndRow both{phongpd::Optimize(world_, asked), {}};
    RequireVerified(both.answer);
    both.row = request.limits
                   ? MotionRow(scene_, world_, request, both.answer)
                   : PolylineRow(scene_, world_, request, both.answer);
    return both;
  });
}

AnswerAndRow Workshop::Retime(const std::vector<Point>& path,
                              const OptimizeRequest& request) {
  return Interruptible([&](const std::atomic<bool>& is_asked) {
    const std::lock_guard<std::mutex> lock(one_at_a_time_);
    OptimizeRequest asked = request;
    asked.is_interrupted = [&is_asked] { return is_asked.load(); };
    Path points;
    for (const Point& p : path) points.push_back(ToVector(p));
    AnswerAndRow both{phongpd::Retime(world_, points, asked), {}};
    RequireVerified(both.answer);
    both.row = MotionRow(scene_, world_, request, both.answer);
    return both;
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
  return scene;
}

}  // namespace phongpd::python
