// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planners/solve/fleet_pairs.h"
#include "planners/solve/optimize.h"

namespace phongpd {

// One of several robots that translate in one room.
struct FleetRobot {
  std::string name;
  // The robot itself and what is fixed.  Equal robots share a world: copies of
  // a World share what it builds.
  World world;
  OptimizeRequest request;  // with limits
};

// What OptimizeFleet answers.
struct FleetAnswer {
  // kConverged: all robots have motions.  Else the status of the robot that has
  // none.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence where there is no motion of all
  // In the order of the robots; empty for those whose turn did not come.
  std::vector<PathAnswer> robots;
  // Each two robots, and each robot with each moving obstacle, judged again at
  // the end; empty unless all robots have motions.
  std::vector<FleetPair> pairs;
  std::vector<std::size_t> order;  // who went first, of the last try
  int tries = 0;                   // of orders; 0: one has no motion even alone
  // Of all motions made faster together; 0: they are those of the order.
  int rounds_together = 0;
  double by_order = 0.0;  // the duration of those, s
  double duration = 0.0;  // until all have arrived, s
  double seconds = 0.0;

  bool IsSolved() const { return status == PathStatus::kConverged; }
  // The pair that comes closest; null: there is none.
  const FleetPair* Closest() const;
};

// Motions of several robots in one room, one robot after the other by priority.
// Each keeps off what is fixed, off the moving obstacles of its own request,
// and off the robots before it, which move as found and then rest at their
// goals (Optimize with moving obstacles).  All begin at time 0.
//
// First each robot moves alone; if one finds no motion even so, that is the
// answer.  The first order begins with the robots that stay where they are;
// then come the others, the slowest first.  A robot that finds no motion goes
// to the front, and all begin again, until this gives no new order.  Once all
// have motions, these are made faster together if that is possible, also among
// obstacles that move and through places on the way (joint_curves.h); then all
// robots arrive at the same time.  As long as all could still arrive sooner,
// the last robot to arrive by the order goes earlier in some more orders, and
// the soonest end is kept: no more orders with the preset fast, one with
// balanced, six with tight (the largest preset of the requests counts).
//
// Where all could still arrive sooner, motions on which all turn the same way
// (joint_turns.h) are made faster together as well; where these arrive sooner,
// they are the answer, and no more orders are tried.
//
// The answer is certified for each pair and for all t ≥ 0.  No answer is no
// proof that there is none.  kVerificationFailed: a pair is not free, or is
// refuted on the solids, if a request asks to verify.
//
// Throws InputError before anything is built: for a name used twice, for
// requests that Optimize would refuse, for two robots that touch at their
// starts or at their goals; and for several robots also for a given duration
// and for ends in motion.
FleetAnswer OptimizeFleet(const std::vector<FleetRobot>& robots);

// Only checks: throws what OptimizeFleet throws, and does nothing else.
void RequireFleet(const std::vector<FleetRobot>& robots);

}  // namespace phongpd
