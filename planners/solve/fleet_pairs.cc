// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/fleet_pairs.h"

#include <algorithm>

#include "constraints/moving_judge.h"
#include "constraints/relative_motion.h"

namespace phongpd {
namespace {

constexpr int kMoments = 400;
constexpr int kRefinements = 12;

// The least distance seen, and when: even moments, then thirds about the least.
void LookForLeast(const Trajectory& robot, const MovingBody& body, double until,
                  FleetPair* pair) {
  const auto room = [&](double t) {
    return body.space->Clearance(robot.At(t).position -
                                 body.motion.At(t).position);
  };
  pair->least = room(0.0);
  const auto look = [&](double t) {
    const double found = room(t);
    if (!(found < pair->least)) return;
    pair->least = found;
    pair->time = t;
  };
  const double step = until / kMoments;
  for (int i = 1; i <= kMoments; ++i) look(step * i);
  double reach = step;
  for (int i = 0; i < kRefinements; ++i) {
    const double middle = pair->time;
    for (const double side : {-0.5, 0.5}) {
      look(std::clamp(middle + side * reach, 0.0, until));
    }
    reach *= 0.5;
  }
}

// The most of what was seen that can be proved.
double Proved(const Trajectory& robot, const MovingBody& body, double until,
              double least) {
  for (const double share : {0.99, 0.9, 0.75, 0.5, 0.25, 0x1p-5, 0x1p-10}) {
    const double clearance = share * least;
    if (CheckAgainst({body}, robot, 0.0, until, clearance).IsFree()) {
      return clearance;
    }
  }
  return 0.0;
}

Verification VerifyPair(const Solid& robot, const MovingObstacle& other,
                        const Trajectory& motion, double until) {
  Workspace pair;
  pair.robot = robot;
  pair.obstacles = {other.solid};
  return Verifier(pair).VerifyCurve(
      RelativeMotionOf(motion, other.motion, until).curve);
}

}  // namespace

FleetPair JudgePair(const RobotInTime& robot, const MovingObstacle& other,
                    bool verifies) {
  FleetPair pair;
  pair.first = robot.name;
  pair.second = other.solid.name();
  const double until =
      std::max(robot.motion.duration(), other.motion.duration());
  const MovingBody body = MovingBodies(robot.world, {other}).front();
  pair.is_free = CheckAgainst({body}, robot.motion, 0.0, until).IsFree();
  LookForLeast(robot.motion, body, until, &pair);
  if (pair.is_free && pair.least > 0.0) {
    pair.clearance = Proved(robot.motion, body, until, pair.least);
  }
  if (verifies) {
    pair.verification =
        VerifyPair(robot.world.workspace().robot, other, robot.motion, until);
  }
  return pair;
}

}  // namespace phongpd
