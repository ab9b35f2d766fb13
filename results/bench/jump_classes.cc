// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/jump_classes.h"

namespace phongpd::bench {

using Eigen::Vector3d;

const char* ToString(JumpClass kind) {
  constexpr const char* kNames[kJumpClasses] = {"fold inside", "exit elsewhere",
                                                "steep but continuous", "bug"};
  return kNames[static_cast<int>(kind)];
}

JumpClass ClassOfJump(Follower before, const Vector3d& a, const Vector3d& b,
                      const Vector3d& pd, double jump, bool has_branches) {
  constexpr int kParts = 32, kRounds = 3;
  Vector3d from = a, to = b, value = pd;
  double largest = 0.0;
  bool ended = false, elsewhere = false;
  for (int round = 0; round < kRounds; ++round) {
    Follower follow = before;
    Vector3d last = value, least_from = from, least_to = to,
             least_value = value;
    Vector3d at = from;
    largest = -1.0;
    for (int i = 1; i <= kParts; ++i) {
      const Follower here = follow;
      const Vector3d q = from + (to - from) * (static_cast<double>(i) / kParts);
      const MotionStep step = follow(q);
      const double change = (step.pd - last).norm();
      if (change > largest) {
        largest = change;
        before = here;
        least_from = at;
        least_to = q;
        least_value = last;
        ended = step.branch_ended;
        // PD is zero outside.
        elsewhere =
            step.left_elsewhere || step.pd.isZero(0.0) || last.isZero(0.0);
      }
      last = step.pd;
      at = q;
    }
    if (largest <= jump) return JumpClass::kSteep;
    from = least_from;
    to = least_to;
    value = least_value;
  }
  if (elsewhere) return JumpClass::kElsewhere;
  if (ended || !has_branches) return JumpClass::kFold;
  return JumpClass::kBug;
}

}  // namespace phongpd::bench
