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
  // kConverged: all robots have motions; that of the robot that has none.
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence where there is no motion of all
  // In the order of the robots; of those that were not come to, empty.
  std::vector<PathAnswer> robots;
  // All robots two by two, and each with what moves by itself, judged anew when
  // all motions were there; empty without them.
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

// Motions of several robots, by order of priority: each keeps off what is
// fixed, off its own request's moving obstacles, and off the robots before it,
// which move as they were told and then rest at their goals (Optimize with
// moving obstacles).  All begin at the time 0.  Each is asked for alone
// first; one without a motion then ends it all.  In the first order come those
// that stay where they are, then who takes longest alone; a robot that finds no
// motion is put in front of the others, and all begin anew, until no new order
// comes of it.  With motions of all, they are made faster together, where that
// is found (joint_curves.h).  While all could arrive sooner still, the last one
// to arrive goes earlier in some more orders, by the largest preset none
// (fast), one (balanced) or six (tight), and the soonest end of all is kept.
// Made faster together all arrive at the same time.  What is answered is
// certified for each pair, for all t ≥ 0; without an answer it is no proof that
// there is none.  A pair that is not, or is refuted on the solids where a
// request verifies, has the status kVerificationFailed.
//
// Throws InputError, before anything is built: for a name used twice, requests
// that Optimize would refuse, two robots that touch at their starts or at their
// goals, and, of several, a given duration and ends in motion.
FleetAnswer OptimizeFleet(const std::vector<FleetRobot>& robots);

// That, and nothing else.
void RequireFleet(const std::vector<FleetRobot>& robots);

}  // namespace phongpd
