// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize_among_moving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "constraints/relative_motion.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "core/stopwatch.h"
#include "planners/solve/optimize_in_time.h"
#include "planners/trajectory/moving_motion.h"
#include "planners/trajectory/timed_roads.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Where and when the motion meets what moves, and from when on the goal is
// left alone.
std::string NotFound(const std::vector<MovingBody>& bodies,
                     const Trajectory& motion, bool requires_margin) {
  const double last = std::max(motion.duration(), LastMotion(bodies));
  const MovingCheck check = CheckAgainst(bodies, motion, 0.0, last);
  std::string text = "no motion was found that keeps off what moves";
  if (check.IsFree() || requires_margin) text += " by the margin required";
  if (check.IsFree()) return text;
  text += "; the fastest without it meets \"" +
          bodies[static_cast<std::size_t>(check.body)].name +
          "\" at t = " + Rounded(check.time, 6);
  const std::vector<SafeTime> at_goal =
      SafeTimes(motion.pieces().back().back(), bodies, 1e-3 * last, 0.0);
  if (at_goal.empty() ||
      at_goal.back().end < std::numeric_limits<double>::infinity()) {
    return text + ", and the goal is never left alone";
  }
  if (!(at_goal.back().begin > 0.0)) return text;
  return text + ", and the goal is swept until t = " +
         Rounded(at_goal.back().begin, 4);
}

Verification VerifyPair(const Solid& robot, const MovingObstacle& obstacle,
                        const Trajectory& motion) {
  Workspace pair;
  pair.robot = robot;
  pair.obstacles = {obstacle.solid};
  const double until = std::max(motion.duration(), obstacle.motion.duration());
  return Verifier(pair).VerifyCurve(
      RelativeMotionOf(motion, obstacle.motion, until).curve);
}

}  // namespace

void RequireMovingRequest(const World& world, const OptimizeRequest& request) {
  if (request.moving.empty()) return;
  RequireMoving(world, request.moving);
  if (!request.limits) {
    throw InputError(
        "moving: expected limits of the motion as well, found none; a path "
        "without times cannot keep off what moves");
  }
  if (request.duration > 0.0) {
    throw InputError("duration: among moving obstacles expected none, found " +
                     FormatDouble(request.duration) +
                     " s; the motion takes as few seconds as are found");
  }
  if (!request.departure.IsAtRest() || !request.arrival.IsAtRest()) {
    throw InputError(
        "departure, arrival: among moving obstacles expected rest at both "
        "ends, found a velocity or an acceleration");
  }
}

bool AreEndsClear(const World& world, const OptimizeRequest& request,
                  const Vector3d& start, const Vector3d& goal,
                  PathAnswer* answer) {
  answer->reason = MovingAtStart(world, request.moving, start, "start");
  if (!answer->reason.empty()) {
    answer->status = PathStatus::kStartInCollision;
    return false;
  }
  answer->reason = MovingAtEnd(world, request.moving, goal, "goal");
  if (!answer->reason.empty()) answer->status = PathStatus::kGoalInCollision;
  return answer->reason.empty();
}

bool IsBlockedByMoving(const World& world, const Vector3d& start,
                       const Vector3d& goal, const PathAnswer& answer) {
  const bool at_start = IsStartBlocked(answer.status);
  if (!at_start && !IsGoalBlocked(answer.status)) return false;
  return world.Diagnose(at_start ? start : goal).IsFree();
}

void KeepOffMoving(const World& world, const OptimizeRequest& request,
                   const std::vector<Path>& paths,
                   const std::vector<Trajectory>& motions, PathAnswer* answer) {
  if (request.moving.empty()) return;
  const Stopwatch stopwatch;
  const CurveOptions options = CurveOptionsOf(world, request);
  const FreeSpace& fixed = *answer->evidence.free_space;
  const std::vector<MovingBody> bodies = MovingBodies(world, request.moving);
  std::vector<FixedMotion> ways;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!motions[i].empty()) ways.push_back({paths[i], motions[i]});
  }
  const MovingTask task = {fixed,
                           bodies,
                           world.workspace().bounds,
                           world.diagonal(),
                           options,
                           request.requires_margin};
  const MovingMotion found = FindMotionAmong(task, ways);
  const double seconds = stopwatch.Seconds();
  answer->seconds += seconds;
  CurveSummary& curve = *answer->curve;
  const bool is_as_it_was =
      !found.motion.empty() && found.motion.duration() == curve.duration;
  const Trajectory fixed_motion = std::move(answer->motion);
  answer->motion = curve.trajectory = found.motion;
  curve.duration = answer->motion.duration();
  curve.seconds += seconds;
  if (found.motion.empty()) {
    answer->reason = NotFound(bodies, fixed_motion, request.requires_margin);
    if (found.is_cut_short) answer->reason += "; the search was ended early";
    answer->status = curve.status = PathStatus::kFailed;
    answer->is_free = answer->is_solved = false;
    answer->length = answer->clearance = 0.0;
    curve.clearance = curve.margin = 0.0;
    answer->evidence.use = {};
    return;
  }
  // There is no more than a search behind it.
  if (!is_as_it_was) answer->status = curve.status = PathStatus::kRoundLimit;
  answer->path = ways[found.way].path;
  answer->length = answer->motion.ArcLength();
  answer->clearance = curve.clearance = curve.margin = found.clearance;
  answer->evidence.use = BoundLimitUse(answer->motion, options.limits);
}

void VerifyAmongMoving(const World& world, const OptimizeRequest& request,
                       PathAnswer* answer) {
  if (!answer->evidence.verification || answer->motion.empty()) return;
  const Stopwatch stopwatch;
  Verification& worst = *answer->evidence.verification;
  for (const MovingObstacle& obstacle : request.moving) {
    Verification one =
        VerifyPair(world.workspace().robot, obstacle, answer->motion);
    worst.tests += one.tests;
    worst.seconds += one.seconds;
    if (one.verdict <= worst.verdict) continue;
    worst.verdict = one.verdict;
    worst.reason = "moving \"" + obstacle.solid.name() + "\": " + one.reason;
  }
  answer->evidence.verification_seconds += stopwatch.Seconds();
  if (worst.verdict != Verdict::kRefuted) return;
  answer->status = PathStatus::kVerificationFailed;
  answer->reason = worst.reason;
  answer->is_free = answer->is_solved = false;
}

}  // namespace phongpd::internal
