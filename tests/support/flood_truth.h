// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/exact/contact_surface_planner.h"

// Planners against flood fills, which know of any two configurations whether
// there is a way between them, and of no way how good it is.
namespace phongpd::testing {

// What a planner must say between configurations in the connected parts of
// free space of these numbers; −1: not free.
inline PathStatus FloodTruth(int start_part, int goal_part) {
  if (start_part < 0) return PathStatus::kStartInCollision;
  if (goal_part < 0) return PathStatus::kGoalInCollision;
  return start_part == goal_part ? PathStatus::kSolved
                                 : PathStatus::kInfeasibleProved;
}

// The least that is complete: any one way.
inline ContactSurfaceOptions LeastSettings() {
  ContactSurfaceOptions options;
  options.routes = 1;
  options.random_cuts = 0;
  options.spacing = 1.0;
  options.gap_links = 0;
  return options;
}

}  // namespace phongpd::testing
