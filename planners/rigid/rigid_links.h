// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <utility>

#include "constraints/rigid/rigid_judge.h"
#include "core/stopwatch.h"

namespace phongpd::internal {

// When a search ends from outside.
class RigidStop {
 public:
  RigidStop(double time_limit, std::function<bool()> is_interrupted)
      : time_limit_(time_limit), is_interrupted_(std::move(is_interrupted)) {}

  // Asks; once it has to stop it stays so.
  bool Asks();
  bool IsInterrupted() const { return interrupted_; }
  double Seconds() const { return watch_.Seconds(); }

 private:
  Stopwatch watch_;
  double time_limit_;
  std::function<bool()> is_interrupted_;
  bool stopped_ = false, interrupted_ = false;
};

// The judge as planners ask it: what it does not decide with some effort is not
// free, nor is anything after the search was stopped.  Counts.
class RigidLinks {
 public:
  RigidLinks(const RigidJudge& judge, RigidStop* stop)
      : judge_(judge), stop_(stop) {}

  bool IsFree(const RobotPose& a, const RobotPose& b);

  // A share t so that the motion from the start to the pose At(t) is free,
  // proved; 1: all of it.  By halving: before t + margin + tolerance it was
  // seen to collide, or is not decided.  Of what is free without a margin half
  // is kept at least, if that is more than the tolerance; 0: nothing is.
  double FreeShare(const RigidMotion& motion, double tolerance, double margin);

  bool IsStopped() const { return is_stopped_; }
  // What others than the judge looked at.
  void AddTests(long tests) { tests_ += tests; }
  long checks() const { return checks_; }
  long tests() const { return tests_; }

 private:
  RigidCheck Check(const RigidMotion& motion);

  const RigidJudge& judge_;
  RigidStop* stop_;
  bool is_stopped_ = false;
  long checks_ = 0, tests_ = 0;
};

}  // namespace phongpd::internal
