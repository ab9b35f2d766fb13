// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/path_status.h"

namespace phongpd {

const char* ToString(PathStatus status) {
  switch (status) {
    case PathStatus::kSolved:
      return "solved";
    case PathStatus::kPolished:
      return "polished";
    case PathStatus::kStalledFeasible:
      return "stalled_feasible";
    case PathStatus::kFree:
      return "free";
    case PathStatus::kRepaired:
      return "repaired";
    case PathStatus::kConverged:
      return "converged";
    case PathStatus::kSmallestTrust:
      return "smallest_trust";
    case PathStatus::kRoundLimit:
      return "round_limit";
    case PathStatus::kInterrupted:
      return "interrupted";
    case PathStatus::kTimeLimit:
      return "time_limit";
    case PathStatus::kInfeasibleProved:
      return "infeasible_proved";
    case PathStatus::kStartInCollision:
      return "start_in_collision";
    case PathStatus::kGoalInCollision:
      return "goal_in_collision";
    case PathStatus::kStartOutOfBounds:
      return "start_out_of_bounds";
    case PathStatus::kGoalOutOfBounds:
      return "goal_out_of_bounds";
    case PathStatus::kViaNotFree:
      return "via_not_free";
    case PathStatus::kNotFree:
      return "not_free";
    case PathStatus::kDurationTooShort:
      return "duration_too_short";
    case PathStatus::kClearanceMissed:
      return "clearance_missed";
    case PathStatus::kNotCertified:
      return "not_certified";
    case PathStatus::kVerificationFailed:
      return "verification_failed";
    case PathStatus::kFailed:
      break;
  }
  return "failed";
}

bool HasFreePath(PathStatus status) {
  return status == PathStatus::kSolved || status == PathStatus::kPolished ||
         status == PathStatus::kStalledFeasible ||
         status == PathStatus::kFree || status == PathStatus::kRepaired;
}

bool IsStartBlocked(PathStatus status) {
  return status == PathStatus::kStartInCollision ||
         status == PathStatus::kStartOutOfBounds;
}

bool IsGoalBlocked(PathStatus status) {
  return status == PathStatus::kGoalInCollision ||
         status == PathStatus::kGoalOutOfBounds;
}

}  // namespace phongpd
