// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/trajectory.h"
#include "core/contact/contact_space.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// Reads "V,A,J", limits of velocity, acceleration and jerk: each one number,
// of all axes, or x/y/z.  Throws InputError starting with `what` for anything
// else, and for numbers that are not above 0.
MotionLimits ParseLimits(const std::string& text, const std::string& what);

// Reads "X,Y,Z[,LENGTH[,DWELL]]", a place on the way, LENGTH as ParseClearance
// does.  Throws InputError starting with `what`.
SceneVia ParseVia(const std::string& text, const std::string& what,
                  double diagonal, const std::string& unit);

// A motion in time that answers a scene, or why there is none.
struct TimedTrajectory {
  std::string planner;                // of the path; empty: it was given
  std::string model = "none";         // it is certified in: "full", "window"
  std::string status;                 // of the curve, or what came before it
  std::string reason;                 // one sentence where the status needs one
  std::vector<Eigen::Vector3d> path;  // that it began with
  // What a proof that there is none rests on; none: the world's sealed space.
  std::optional<ContactSpace> surface;
  CurveSummary curve;  // no trajectory: none was found
  // Free and within the limits for all t, judged once more as it is.
  bool is_certified = false;
  LimitUse use;  // upper bounds
  double plan_seconds = 0.0;
};

// The scene's preset, margin, places on the way and duration.
CurveOptions SceneCurveOptions(const Scene& scene, const World& world,
                               const MotionLimits& limits);

// From the scene's start to its goal by way of options.via: along the paths of
// contact-surface from place to place, in the scene's trajectory.model
// (model_choice.h).  A place that is not free has the status via_not_free.
// Where no path leads from one to the next, that is no proof for places within
// their tolerances: the status is failed.  Throws InputError for bad options,
// and where all places are the same, before anything is built; what
// PlanningStudy::Run throws.
TimedTrajectory PlanInTime(const Scene& scene, const World& world,
                           const CurveOptions& options);

// Near a path of somebody's own, of which options.via are points; the scene's
// start and goal count for nothing.
// Asks free space alone, which is enough.  A path that collides has the status
// not_free and the place as reason.  Throws InputError as above, and for paths
// without two different points.
TimedTrajectory TimePath(const World& world,
                         const std::vector<Eigen::Vector3d>& path,
                         const CurveOptions& options);

// One row of results, with the keys the command line documents.
nlohmann::ordered_json TimedRow(const Scene& scene, const World& world,
                                const CurveOptions& options,
                                const TimedTrajectory& timed);

}  // namespace phongpd
