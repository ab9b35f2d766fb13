// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "constraints/trajectory.h"
#include "planners/exact/verification.h"
#include "planners/world/moving_obstacle.h"
#include "planners/world/world.h"

namespace phongpd {

// A robot with its motion in time, at rest before and after it.
struct RobotInTime {
  std::string name;
  World world;
  Trajectory motion;  // not empty
};

// Two that move in one room, judged apart from all others by the motion of the
// second one relative to the first.
struct FleetPair {
  std::string first, second;
  // They keep off each other for all t ≥ 0, proved by the judge of curves
  // against their contact space (moving_judge.h).
  bool is_free = false;
  double clearance = 0.0;  // a lower bound of their distance, proved
  // The least distance over 400 moments at equal intervals, refined around the
  // least of them, rounded, and when that is; user's unit, seconds.
  double least = 0.0;
  double time = 0.0;
  // By other code, on the original solids; none: nobody asked.
  std::optional<Verification> verification;
};

// Of a robot and what else moves.
FleetPair JudgePair(const RobotInTime& robot, const MovingObstacle& other,
                    bool verifies);

}  // namespace phongpd
