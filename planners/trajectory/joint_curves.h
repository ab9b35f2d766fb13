// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/moving_judge.h"
#include "constraints/trajectory.h"
#include "planners/trajectory/curve_optimizer.h"

// Motions of several robots made faster together.
namespace phongpd::internal {

struct JointRobot {
  std::shared_ptr<const FreeSpace> fixed;
  MotionLimits limits;
  double margin = 0.0;    // clearance wished for, user's unit, ≥ 0
  double required = 0.0;  // clearance without which nothing is an answer
  double diagonal = 1.0;  // D
  Trajectory motion;      // from rest to rest
  bool stays = false;     // it rests at motion.At(0)
  std::vector<MovingBody> bodies{};  // that move by themselves; it keeps off
  std::vector<CurveVia> via{};       // that it passes at joints, in order
};

// Configurations of the first as the second sees it, at which they keep off.
struct JointPair {
  int first = 0, second = 0;
  std::shared_ptr<const FreeSpace> space;
};

struct JointTask {
  std::vector<JointRobot> robots;
  std::vector<JointPair> pairs;
  double wanted = 0.0;                   // as good as can be expected, s
  int halvings = 0;                      // of pieces, in the end
  double time_limit = 0.0;               // s
  std::function<bool()> is_interrupted;  // asked between rounds
};

struct JointMotions {
  std::vector<Trajectory> motions;  // all of one duration; empty: none better
  int rounds = 0;
};

// Motions that all take the same time, less than the longest one given, each
// within its limits and free of what is fixed and of its bodies, through its
// places, and free of each other by the judge of curves, the relative motions
// rounded: whoever answers for them judges the pairs (moving_judge.h).
//
// The motions given, taken at even times as curves of degree 5 with knots in
// common, and then rounds as OptimizeCurve has them: half-spaces between each
// and what is fixed and, of their differences, between each two and between
// each and what moves by itself (joint_bodies.h); knots that stay in their
// places (joint_places.h); one convex program for all
// (joint_interior_point.h), in which whoever has time gives way to who has
// none; what it says is kept if it is faster and free.  A local
// minimum: nobody passes on the other side of another than the motions given
// do.  No clearance falls by more than the margin leaves.
JointMotions HastenTogether(const JointTask& task);

}  // namespace phongpd::internal
