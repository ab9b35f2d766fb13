// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "planners/rigid/rigid_links.h"
#include "planners/rigid/rigid_model.h"
#include "planners/rigid/tree_search.h"

namespace phongpd::internal {

// What came of a race.
struct RaceEnd {
  // Of the lane that won; empty: none found one until the stop.
  std::vector<RobotPose> path;
  const char* planner = "";  // of its portfolio, who found it
  std::uint64_t seed = 0;    // its own
  // Of the lane that won: those that lost end wherever their threads happen to
  // be.  Where none won, of all.
  long checks = 0, tests = 0, nodes = 0;
};

// Of lane 0 the seed itself, of the others one that is mixed from both.
std::uint64_t LaneSeed(std::uint64_t seed, int lane);

// So many portfolios, lanes 0, 1, …, each with its seed and on its thread; lane
// 0 is the caller's.  In each the work until it has a path is a function of its
// seed; the lane with the least wins, the lower one where two are equal.  A
// lane that has a path tells the others its work, and each of them goes on
// until it has a path for less, or has done more.  So who wins depends neither
// on the machine's load nor on the number of its processors, and nobody waits
// for others before that.  Only if `stop` ends the race meanwhile is the winner
// whoever was best until then.
//
// `stop` is asked by the caller's thread only, before each motion that lane 0
// judges and every few milliseconds while it waits for the others to catch up.
//
// Threads are joined whatever happens; what is thrown in any of them is thrown
// here, of several what the lowest lane threw.  Throws std::system_error if a
// thread cannot be started.
RaceEnd RacePortfolios(const RigidModel& model, const TreeTask& task,
                       std::uint64_t seed, int lanes, RigidStop* stop);

}  // namespace phongpd::internal
