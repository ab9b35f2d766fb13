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

// The scene's preset and margin.
CurveOptions SceneCurveOptions(const Scene& scene, const World& world,
                               const MotionLimits& limits);

// From the scene's start to its goal: along the path of contact-surface, in the
// scene's trajectory.model (model_choice.h).  Throws InputError for bad
// options, and where start and goal are the same, before anything is built;
// what PlanningStudy::Run throws.
TimedTrajectory PlanInTime(const Scene& scene, const World& world,
                           const CurveOptions& options);

// Near a path of somebody's own; the scene's start and goal count for nothing.
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

// No more rows in a table of a motion.
inline constexpr double kMostTimedRows = 1e7;

// "t,x,y,z,vx,vy,vz,ax,ay,az" at 0, 1/rate, 2/rate, ... and at the end; of an
// empty trajectory the names only.  Throws InputError for more than
// kMostTimedRows.
std::string TimedCsv(const Trajectory& trajectory, double rate);

}  // namespace phongpd
