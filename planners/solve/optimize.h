// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planners/solve/path_answer.h"
#include "planners/world/moving_obstacle.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/via.h"

namespace phongpd {

// A metric of your own inside obstacles (SignedMetric), for comparisons.  Rows,
// and the world that keeps it, know it by its name.
struct OwnMetric {
  std::string kind;  // "mixed"
  std::string name;  // "mixed@0.2"
  std::function<std::shared_ptr<const PenetrationMetric>(
      const ContactSpace& space, const PhongMetricOptions& options)>
      make;
};

// A short way from start to goal that keeps clear.
struct OptimizeRequest {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  Model model = Model::kAuto;
  // Distance kept where there is room, in (0, D]; none: DefaultMargin(), which
  // a motion in time keeps only where that costs little.
  std::optional<Length> margin{};
  bool requires_margin = false;  // less is no answer
  Preset preset = Preset::kBalanced;

  // With limits the answer is a motion in time (curve_optimizer.h), at rest at
  // both ends unless said; without, a polyline.
  std::optional<MotionLimits> limits{};
  std::vector<Via> via{};  // places on the way, in order
  double duration = 0.0;   // seconds that it takes; 0: as few as can be
  CurveEnd departure{}, arrival{};
  // The robot keeps off these, on its way and after it has arrived.
  std::vector<MovingObstacle> moving{};
  // Asked now and then; true ends the search for a faster motion.
  std::function<bool()> is_interrupted{};

  // Of polylines (trajectory_problem.h).
  PenetrationSpec penetration{};
  std::optional<OwnMetric> own_metric{};  // in place of penetration.metric
  int waypoints = 40;
  int samples_per_segment = 0;  // 0: by the Lipschitz rule
  double max_segment_ratio = kMaxSegmentRatio;
  bool is_per_obstacle = false;  // a contact space each instead of one for all
  double search_time = 5.0;      // seconds of each search of kWindow
  // Its time_limit and routes hold for motions as well.
  PipelineOptions options{};

  bool verifies = true;  // on the original solids as well (verification.h)

  // The margin that holds.
  Length Margin() const { return margin.value_or(DefaultMargin()); }
  // What Optimize refuses in that world before it builds anything: throws
  // InputError.
  void Validate(const World& world) const;
};

// Writes what a preset means into a request: request->preset, the options'
// routes, and for polylines `also_line` and `polish`.  Set other values
// afterwards.
void ApplyPreset(Preset preset, OptimizeRequest* request);

// Writes what was measured to answer most often within so many seconds of
// processors, builds included, for as many triangles: preset, model, metric
// (results/trade/budget.md).  It limits nothing: time limits do.  Set other
// values afterwards.  Of polylines: of motions in time nothing was measured.
// Throws InputError unless seconds are finite and > 0.
void ApplyBudget(double seconds, const Workspace& workspace,
                 OptimizeRequest* request);

// Optimises in a world.  The world builds what is needed on the first request,
// and keeps it: contact spaces, metrics, the graph that repairs starts.  If
// start or goal is not free, the answer says so before anything is built.
//
// Without limits: TrajectoryPipeline with the metric asked for, one solve at a
// time in a process.
//
// With Model::kWindow, the metrics euclidean and smoothed, with one row a
// sample, are computed from the parts of C_cont near the iterates
// (PathAnswer::windows, window_metric.h); rrt-connect finds the starts.  With
// another metric, more rows or a contact space per obstacle, only free space is
// modelled, and there is no metric to follow (OptimizeInFreeSpace).  The same
// happens if the windows fail; the answer's evidence then says why.
//
// With limits: OptimizeCurve, from the path that contact-surface finds from
// place to place.  If a place is not free the status is kViaNotFree.  If no
// path leads from one place to the next the status is kFailed: it is no proof,
// since another point within the tolerance may do.  Of the ways that
// contact-surface finds, up to eight (with kFast not more than are asked for),
// as many as options.routes are followed to the end, side by side: those along
// which kFast leads to the best motions (best_curve.h).  The best of what they
// come to is the answer.
//
// Among moving obstacles (request.moving) the motion begins and ends at rest.
// It is the fastest that was found: by waiting, going first, making way, or by
// another route (moving_motion.h).  It keeps off them for all t ≥ 0, also while
// the robot rests at its goal.  kFailed: none was found, which is no proof.
// kStartInCollision, kGoalInCollision: one of them begins on the start, or ends
// on the goal.
//
// Throws InputError for bad requests, and BuildRefusal if limits of the world
// do not allow what Model::kFull needs.
PathAnswer Optimize(const World& world, const OptimizeRequest& request);

// The same near a free path of your own.  Its ends are start and goal, in place
// of the request's; the places of request.via are points of it.  The motion
// leaves the path to make way for moving obstacles, if there is no via.  Only
// free space is modelled, which is enough.  If the path collides the status is
// kNotFree, and the reason says where.  Throws InputError as above, also
// without limits, and for a path without two different points.
PathAnswer Retime(const World& world, const Path& path,
                  OptimizeRequest request);

// The problem of a polyline in the world: with settings, metrics and judge of
// the whole model, or with the judge of the window and no metric.
TrajectoryProblem ProblemOf(const World& world, const OptimizeRequest& request,
                            Model model = Model::kFull);

// One sentence if start or goal has less than the margin asked for; else empty.
// Builds nothing.
std::string MarginBeyondReach(const World& world,
                              const OptimizeRequest& request);

}  // namespace phongpd
