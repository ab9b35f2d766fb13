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

// A place that the curve passes on its way.
struct CurveVia {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double tolerance = 0.0;  // largest distance from it, user's unit, > 0
  double dwell = 0.0;  // seconds to rest, ≥ 0; if > 0, exactly at the point
};

struct CurveOptions {
  MotionLimits limits;  // at least one for each axis
  // Velocity and acceleration at both ends; within the limits, also a moment
  // after the start and before the end.
  CurveEnd start, end;
  std::vector<CurveVia> via;  // in order; each is a point of the path
  // The duration asked for, seconds: the curve then has as little jerk as could
  // be found.  It must begin and end at rest, without a dwell.  0: as short a
  // duration as could be found.
  double duration = 0.0;
  double margin = 0.0;  // clearance wished for, user's unit, ≥ 0
  // What missing a clearance of D would cost, as a share of the duration; > 0.
  // At 50 much of a margin goes where that saves a little time; at 200 nearly
  // none does where there is room.  No price proves that it is kept: see
  // CurveSummary::margin.
  double margin_price = 50.0;
  // How long to look for a faster curve.  kFast: three pieces for each segment
  // of the path, six for one or two.  kBalanced: then each piece is halved, and
  // once more if there are fewer than 40.  kTight: halved twice, and once more
  // if there are fewer than 80: a slightly faster curve for several times the
  // work.
  Preset preset = Preset::kBalanced;
  double time_limit = std::numeric_limits<double>::infinity();  // seconds, > 0
  // Called between rounds; returning true stops, as the time limit does.
  std::function<bool()> is_interrupted;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// One round of OptimizeCurve.
struct CurveRound {
  double duration = 0.0;  // of the best curve after the round, seconds
  double sigma = 0.0;  // trust region: |ln| of the change of a piece's duration
  // By which share the objective should fall, and by which it did (of a round
  // that is not accepted: would have).
  double predicted = 0.0, gain = 0.0;
  int pieces = 0, planes = 0, rows = 0, iterations = 0;
  bool is_accepted = false;
};

struct CurveSummary {
  PathStatus status = PathStatus::kNotFree;
  // A C² curve, proved free for all t (curve_judge.h) and within the limits for
  // all t (BoundLimitUse).  It has the ends asked for, to rounding, and passes
  // the places of `via` in order.  Empty if kNotFree or kDurationTooShort.
  Trajectory trajectory;
  double duration = 0.0;   // seconds
  double clearance = 0.0;  // a lower bound, to rounding; user's unit
  double margin = 0.0;     // the part of the wished margin that is kept
  // duration · (1 + margin_price m/D), seconds, where m is what the pieces lack
  // of the margin, on average: what says which of several curves is the best.
  double cost = 0.0;
  std::vector<CurveRound> rounds;
  double stops_duration = 0.0;  // of the first certified curve, seconds
  double first_seconds = 0.0;   // wall time until that curve
  double seconds = 0.0;         // wall time of the whole call
};

// Turns a planner's path into a motion for a machine: a fast curve in time,
// piecewise of degree 5, near a free polyline.
//
// The first curve stops at the corners of the path; it is an answer already.
// Each round then puts half-spaces between the pieces and the obstacles near
// them, solves a convex program within these (curve_program.h), and scales time
// so that the limits hold exactly.  The new curve is kept only if it is faster
// and the judge of curves finds it free.  When rounds gain little, pieces are
// halved.  So there is a certified curve whenever it ends; without a margin,
// the duration falls from round to round.  If a duration is given, the mean of
// |q'''|² falls instead, each axis relative to its limit.  The result is a
// local minimum: it passes obstacles on the same side as the path.
//
// `diagonal` D > 0 is the length that steps and tolerances refer to, user's
// unit.  `free_path` has at least two different points.  Throws InputError for
// options and for points that are not finite.  It also throws, before the first
// round, if the robot cannot stop in free space after a start in motion, or
// before an end in motion; the message tells the distance this takes.
//
// Optimize of planners/solve/optimize.h does this for a World.
CurveSummary OptimizeCurve(const FreeSpace& space, double diagonal,
                           const std::vector<Eigen::Vector3d>& free_path,
                           const CurveOptions& options);

}  // namespace phongpd
