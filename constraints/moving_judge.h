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

// What moves by itself, as the robot meets it.
struct MovingBody {
  std::string name;
  // Configurations of the robot at which it keeps off the body, while that
  // rests at 0; without bounds.  Equal bodies share it.
  std::shared_ptr<const FreeSpace> space;
  // Where it is moved to, from the time 0 on; before it rests at the beginning,
  // afterwards at the end.
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
// for `until` seconds?  Where the curve takes less it rests at its end.  "Free"
// is a theorem about the polynomials given, for all t: the relative motions
// (relative_motion.h) are free with the rounding they have.  Collisions are
// told of rounded relative configurations.  With `clearance` > 0, does it keep
// that distance from all of them?  Nothing else is "free" then.
//
// Throws InputError as RelativeMotionOf.
MovingCheck CheckAgainst(const std::vector<MovingBody>& bodies,
                         const Trajectory& curve, double begin, double until,
                         double clearance = 0.0);

// Is the robot, on this curve from 0 on and at its end for ever after, free of
// what is fixed and of the bodies, also when all of them have come to rest?
MovingCheck CheckCurveAmong(const FreeSpace& fixed,
                            const std::vector<MovingBody>& bodies,
                            const Trajectory& curve, double clearance = 0.0);

// A distance that it keeps from all of them all the time: proved, at most
// `at_most` ≥ 0, and within an eighth of the most that can be proved down to
// 2⁻²⁰ of `at_most`; 0 where it keeps less, or is not free.
double ProvedClearance(const FreeSpace& fixed,
                       const std::vector<MovingBody>& bodies,
                       const Trajectory& curve, double at_most);

// Until when a body moves; 0: none does.
double LastMotion(const std::vector<MovingBody>& bodies);

}  // namespace phongpd
