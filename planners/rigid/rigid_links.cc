// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_links.h"

#include <algorithm>

namespace phongpd::internal {
namespace {

// Of one motion, about a tenth of a second: others are cheaper to try.
constexpr long kSearchTests = 300'000;

// When it was seen to collide, or begins to be undecided.
double HitOf(const RigidCheck& check) {
  return check.outcome == MotionVerdict::kCollides ? check.time : check.from;
}

}  // namespace

bool RigidStop::Asks() {
  if (stopped_) return true;
  interrupted_ = is_interrupted_ && is_interrupted_();
  stopped_ = interrupted_ || watch_.Seconds() > time_limit_;
  return stopped_;
}

RigidCheck RigidLinks::Check(const RigidMotion& motion) {
  if (is_stopped_ || stop_->Asks()) {
    is_stopped_ = true;
    RigidCheck undecided;
    undecided.from = 0.0;
    return undecided;
  }
  const RigidCheck check = judge_.Check(motion, kSearchTests);
  ++checks_;
  tests_ += check.tests;
  return check;
}

bool RigidLinks::IsFree(const RobotPose& a, const RobotPose& b) {
  return Check(RigidMotion(a, b)).IsFree();
}

double RigidLinks::FreeShare(const RigidMotion& motion, double tolerance,
                             double margin) {
  const RigidCheck whole = Check(motion);
  if (whole.IsFree()) return 1.0;
  double known = 0.0, hit = HitOf(whole);
  while (hit - known > tolerance && !is_stopped_) {
    const double middle = 0.5 * (known + hit);
    const RigidCheck part =
        Check(RigidMotion(motion.At(known), motion.At(middle)));
    if (part.IsFree()) {
      known = middle;
    } else {
      hit = known + HitOf(part) * (middle - known);
    }
  }
  // One motion, not the parts it was seen in.
  for (; known > tolerance && !is_stopped_; known *= 0.5) {
    const double kept = std::max(known - margin, 0.5 * known);
    if (IsFree(motion.start(), motion.At(kept))) return kept;
  }
  return 0.0;
}

}  // namespace phongpd::internal
