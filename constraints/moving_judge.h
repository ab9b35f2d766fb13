// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "constraints/curve_judge.h"
#include "constraints/free_space.h"
#include "constraints/trajectory.h"

namespace phongpd {

// An obstacle that moves by itself, as the robot meets it.
struct MovingBody {
  std::string name;
  // The robot's free space around the body, as if the body rested at 0; without
  // bounds.  Equal bodies share it.
  std::shared_ptr<const FreeSpace> space;
  // Where the body is at each time from 0 on.  Before, it rests at the
  // beginning; afterwards at the end.
  Trajectory motion;
};

struct MovingCheck {
  static constexpr int kFixed = -1;  // what does not move, or bounds

  MotionVerdict verdict = MotionVerdict::kUndecided;
  // As of CurveCheck, on the curve's own clock.
  double free_until = 0.0, time = 0.0;
  int body = kFixed;  // which it meets, or may meet, first
  Eigen::Vector3d configuration = Eigen::Vector3d::Zero();  // of the robot
  long tests = 0;

  bool IsFree() const { return verdict == MotionVerdict::kFree; }
};

// Does the robot on this curve keep off the bodies, from `begin` on their clock
// for `until` seconds?  If the curve is shorter, the robot rests at its end.
// "Free" is a theorem about the given polynomials, for all t: the relative
// motions (relative_motion.h) are free whatever their rounding.  A collision is
// one of a rounded relative configuration.  With `clearance` > 0 the robot is
// "free" only if it keeps that distance from all bodies.
//
// Throws InputError as RelativeMotionOf.
MovingCheck CheckAgainst(const std::vector<MovingBody>& bodies,
                         const Trajectory& curve, double begin, double until,
                         double clearance = 0.0);

// Does the robot keep off what is fixed and off the bodies, on this curve from
// time 0 on and at its end for ever after, until all bodies rest?
MovingCheck CheckCurveAmong(const FreeSpace& fixed,
                            const std::vector<MovingBody>& bodies,
                            const Trajectory& curve, double clearance = 0.0);

// A distance that the robot keeps from all of them all the time, proved, and at
// most `at_most` ≥ 0.  It is within an eighth of the largest that can be
// proved; 0 if that is below 2⁻²⁰ of `at_most`, or if the robot is not free.
double ProvedClearance(const FreeSpace& fixed,
                       const std::vector<MovingBody>& bodies,
                       const Trajectory& curve, double at_most);

// When the last body comes to rest; 0 if none moves.
double LastMotion(const std::vector<MovingBody>& bodies);

}  // namespace phongpd
