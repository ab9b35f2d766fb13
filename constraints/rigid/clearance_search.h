// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/rigid/framed_motion.h"
#include "constraints/rigid/rigid_search.h"

// How close a motion comes, by branch and bound in the frame of the judge.
// Pairs of boxes and triangles are shown to stay farther apart than a target
// for a part of the way, as (2) of rigid_pair.h has it with the target as the
// gap; a pair of triangles that is not shown to be is measured at the middle of
// its part, which may lower the least distance seen, and the target with it,
// and is halved.  A target only falls: what stayed beyond an earlier one stays
// beyond the last.
namespace phongpd::internal {

struct FramedClearance {
  double lower = 0.0, upper = 0.0, time = 0.0;  // in the frame
  // Of `upper`, by their numbers in the trees; −1: one side is inside of the
  // other, or `upper` is what was known before.
  int robot = -1, obstacle = -1;
  bool is_resolved = false;
  long tests = 0;
};

// `absolute` in the frame.  Nothing is looked for above `known`, a distance
// that is reached elsewhere; kInfinity: none is.  Does not allocate.
FramedClearance SearchClearance(const RigidSides& sides,
                                const FramedMotion& motion, double relative,
                                double absolute, double known, long max_tests);

// The answer in the user's unit, rounded outwards.
RigidClearance InUsersUnit(const RigidSides& sides,
                           const FramedClearance& found);

// Throws InputError naming the field.
void RequireTolerance(const ClearanceTolerance& tolerance);

}  // namespace phongpd::internal
