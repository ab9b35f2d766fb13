// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_requests.h"

#include "core/mesh/mesh_error.h"

namespace phongpd {

PlanRequest PlanRequestOf(const Scene& scene) {
  if (!scene.moving.empty()) {
    throw InputError(scene.name +
                     ": /moving: expected none for a path without times, which "
                     "cannot keep off what moves, found " +
                     std::to_string(scene.moving.size()) +
                     "; ask for a motion: phongpd optimize with limits");
  }
  PlanRequest request;
  request.start = scene.start;
  request.goal = scene.goal;
  request.planner = scene.planning.planner;
  request.model = scene.planning.model;
  request.clearance = scene.planning.clearance;
  request.preset = scene.preset;
  request.time_limit = scene.planning.time_limit;
  return request;
}

OptimizeRequest OptimizeRequestOf(const Scene& scene) {
  const TrajectorySettings& settings = scene.trajectory;
  OptimizeRequest request;
  ApplyPreset(scene.preset, &request);
  request.start = scene.start;
  request.goal = scene.goal;
  request.model = settings.model;
  // A scene that says what is the default anyway says nothing of its own.
  if (settings.margin != DefaultMargin()) {
    request.margin = settings.margin;
  }
  request.limits = scene.limits;
  request.via = scene.via;
  request.moving = scene.moving;
  request.duration = scene.duration;
  request.departure = scene.departure;
  request.arrival = scene.arrival;
  request.penetration = scene.penetration;
  request.waypoints = settings.waypoints;
  request.samples_per_segment = settings.samples_per_segment;
  request.max_segment_ratio = settings.max_segment_ratio;
  request.search_time = scene.planning.time_limit;
  request.options.optimizer.ipopt.ipopt_options = settings.ipopt;
  return request;
}

}  // namespace phongpd
