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

// A metric of one's own inside obstacles (SignedMetric), for comparisons; its
// name tells it apart from others, in rows and in the world that keeps it.
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
  // Distance kept where there is room, in (0, D]; none: DefaultMargin().
  std::optional<Length> margin{};
  bool requires_margin = false;  // less is no answer
  Preset preset = Preset::kBalanced;

  // With limits the answer is a motion in time (curve_optimizer.h), at rest at
  // both ends unless said; without, a polyline.
  std::optional<MotionLimits> limits{};
  std::vector<Via> via{};  // places on the way, in order
  double duration = 0.0;   // seconds that it takes; 0: as few as can be
  CurveEnd departure{}, arrival{};
  // To keep off, from the beginning on and when the robot has arrived, too.
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

// What the preset sets in a request: request->preset, the options' routes, and
// of polylines line and polish.  Whoever wants another value sets it
// afterwards.
void ApplyPreset(Preset preset, OptimizeRequest* request);

// Optimises in a world, which builds what it takes on the first request and
// keeps it: contact spaces, metrics, the graph that repairs starts.  A start or
// goal that is not free is said before anything is built.
//
// Without limits: TrajectoryPipeline, by the metric asked for.  In a window
// euclidean and smoothed metrics are followed from what of C_cont lies about
// the iterates (PathAnswer::windows, window_metric.h), one row a sample, and
// rrt-connect finds the starts; with other metrics, rows or layouts, and where
// the answer's evidence says why windows failed, free space is all that is
// modelled and no metric is followed (OptimizeInFreeSpace).  One solve at a
// time in a process.  With limits: OptimizeCurve, from the path of
// contact-surface from place to place.  A place that is not free has the status
// kViaNotFree; where no path leads from one to the next, that is no proof for
// places within their tolerances: the status is kFailed.
// Several routes (options.routes) are the ways that contact-surface compared:
// motions are sought along each, side by side, and the best is the answer.
//
// Among moving obstacles (request.moving) the motion begins and ends at rest
// and takes as few seconds as are found: by waiting, going first, making way,
// or another route (moving_motion.h).  It is free of them for all t ≥ 0, the
// robot resting at its goal, or the status is kFailed: none was found, which is
// no proof.  Where one of them begins on the start, or ends on the goal, the
// status is kStartInCollision or kGoalInCollision.
//
// Throws InputError for bad requests, BuildRefusal where limits of the world
// refuse what Model::kFull needs.
PathAnswer Optimize(const World& world, const OptimizeRequest& request);

// The same near a free path of one's own, of which request.via are points; its
// ends are start and goal instead of the request's.  It is left to make way for
// moving obstacles where there is no via.  Asks free space alone,
// which is enough.  A path that collides has the status kNotFree and the place
// as reason.  Throws InputError as above, without limits, and for paths without
// two different points.
PathAnswer Retime(const World& world, const Path& path,
                  OptimizeRequest request);

// The polyline's problem in the world: settings, metrics and judge of the whole
// model, or the judge of the window and no metric.
TrajectoryProblem ProblemOf(const World& world, const OptimizeRequest& request,
                            Model model = Model::kFull);

// One sentence where start or goal have less than the margin asked for; empty
// otherwise.  Builds nothing.
std::string MarginBeyondReach(const World& world,
                              const OptimizeRequest& request);

}  // namespace phongpd
