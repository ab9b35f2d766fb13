// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// How the answer to a query goes on from the one before it: the words of all
// metrics and of the tracker.  Nothing falls back silently.  Where the robot
// is, inside or outside, is another question: DepthStatus.
enum class QueryStatus {
  // Of a metric, a PenetrationResult.
  kOk,                 // the metric's own answer
  kBranchEnded,        // the warm branch folded on the way, or the motion left
                       // C_obj elsewhere than the branch leads: the answer,
                       // cold or outside, does not continue it
  kEuclideanFallback,  // inside, but no Phong projection exists, or no smoothed
                       // direction is known: Euclidean PD
  // Of all: q is not finite.  All other members are zero; a tracker stays as it
  // was.
  kInvalid,
  // Of a tracker, a TrackerResult.
  kFollowing,      // inside; the contact is where it wants to be
  kSliding,        // inside; the contact is on its way there
  kLeftElsewhere,  // outside, PD zero: q left C_obj so far from the contact
                   // that PD changed by more than (κ + 1)·|Δq|
  kOutside,        // not inside, PD zero
};

// "ok", "branch_ended", "euclidean_fallback", "invalid", "following",
// "sliding", "left_elsewhere", "outside".
const char* ToString(QueryStatus status);

}  // namespace phongpd
