// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "planners/world/path_status.h"
#include "planners/world/preset.h"

namespace phongpd {

// A place to pass on the way.
struct CurveVia {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double tolerance = 0.0;  // the curve comes as close, user's unit; > 0
  double dwell = 0.0;      // seconds to rest there; at the point itself if > 0
};

struct CurveOptions {
  MotionLimits limits;        // one at least for each axis
  CurveEnd start, end;        // within the limits, for a moment longer too
  std::vector<CurveVia> via;  // in order, each a point of the path
  // Seconds that it takes, with as little jerk as can be found; 0: as few as
  // can be.  From rest to rest, without a dwell.
  double duration = 0.0;
  double margin = 0.0;  // clearance wished for, user's unit, ≥ 0
  // How long to look for a faster curve: with three pieces a segment of the
  // path (fast), then each piece halved, once (balanced), twice (tight: a
  // little faster a curve, for a multiple of the work).
  Preset preset = Preset::kBalanced;
  double time_limit = std::numeric_limits<double>::infinity();  // seconds, > 0
  // Asked between rounds; true ends it as the time limit does.
  std::function<bool()> is_interrupted;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

struct CurveRound {
  double duration = 0.0;  // after the round, of the curve kept
  double sigma = 0.0;     // how far durations may change, ln
  // What it was to fall by and what it fell by, or would have: shares.
  double predicted = 0.0, gain = 0.0;
  int pieces = 0, planes = 0, rows = 0, iterations = 0;
  bool is_accepted = false;
};

struct CurveSummary {
  PathStatus status = PathStatus::kNotFree;
  // Free for all t and within the limits for all t, proved (curve_judge.h,
  // BoundLimitUse); at both ends as asked for, to rounding; of class C².  Empty
  // if kNotFree or kDurationTooShort.  It passes the places of `via`, in order.
  Trajectory trajectory;
  double duration = 0.0;
  double clearance = 0.0;  // a lower bound, rounded; user's unit
  double margin = 0.0;     // what of the margin wished for is kept
  std::vector<CurveRound> rounds;
  double stops_duration = 0.0;  // of the first certified answer
  double first_seconds = 0.0;   // until that
  double seconds = 0.0;
};

// A fast curve in time near a free polyline: pieces of degree 5, planner's path
// to machine's motion.
//
// It begins with a motion that stops at the path's corners, which is an answer
// already, and goes on in rounds: half-spaces between the pieces and what is
// near them, a convex program within them (curve_program.h), time scaled so
// that the limits hold exactly.  What a round says is kept only if it is
// faster and the judge of curves finds it free.  Then pieces are halved, and it
// goes on.  So it always has a certified curve, whenever it ends, and without a
// margin its duration falls round by round.  Of a given duration the mean of
// |q'''|² falls instead, each axis as a share of its limit.  It finds a local
// minimum, of the way the path takes.
//
// `diagonal` D > 0 is the length that steps and tolerances refer to.
// `free_path`: two different points at least.  Throws InputError for options,
// for points that are not finite, and, before the first round, if an end in
// motion leaves no free way to stop: with the distance that takes.
CurveSummary OptimizeCurve(const FreeSpace& space, double diagonal,
                           const std::vector<Eigen::Vector3d>& free_path,
                           const CurveOptions& options);

}  // namespace phongpd
