// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// What came of asking for a path or a motion: the words of all planners and
// optimisers.
enum class PathStatus {
  // There is a path, exactly free.
  kSolved,           // as asked for; of an optimiser: Ipopt converged to it
  kPolished,         // the corridor converged to it
  kStalledFeasible,  // nothing converged
  // There is a path, or a motion in time, certified for all t; the search for a
  // shorter or faster one
  kConverged,   // gains next to nothing
  kRoundLimit,  // still gained
  // Ended from outside; a planner for bodies that turn had not found a path
  // yet.
  kInterrupted,
  // Time was up: of a motion, which there is, for a faster one; of a sampler
  // before it had found a path.
  kTimeLimit,
  // There is none, proved: start and goal lie in different cells.
  kInfeasibleProved,
  // What was given is not free.
  kStartInCollision,
  kGoalInCollision,
  kStartOutOfBounds,  // and in no collision
  kGoalOutOfBounds,
  kViaNotFree,  // a place on the way
  kNotFree,     // the path to follow
  // There is one, but not as asked for.
  kDurationTooShort,  // no motion as fast as that was found
  kClearanceMissed,   // it keeps less than is required
  // The judge of curves did not confirm what was found.
  kNotCertified,
  // The second judge, on the original solids, refuted it: a fault of ours.
  kVerificationFailed,
  kFailed,  // neither path nor proof
  // Of steps on the way, which have words of their own.
  kFree,           // start repair: the given path was free already
  kRepaired,       // start repair: it was not, and is now
  kSmallestTrust,  // corridor: no step of any size shortens the path
};

// "solved", "stalled_feasible", "start_in_collision", …
const char* ToString(PathStatus status);

// Does the status of a path, not of a motion, say that there is one?  The first
// three and the two of start repair.
bool HasFreePath(PathStatus status);
// kStartInCollision, kStartOutOfBounds; the same of the goal.
bool IsStartBlocked(PathStatus status);
bool IsGoalBlocked(PathStatus status);

}  // namespace phongpd
