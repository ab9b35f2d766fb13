// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "results/bench/motion_cases.h"

namespace phongpd::bench {

enum class JumpClass {
  kFold,       // inside: the answer itself is not continuous there, and the
               // metric says so, or (Euclidean) has nothing to say
  kElsewhere,  // the robot leaves, or enters, far from its contact
  kSteep,      // continuous: gone where the step is divided
  kBug,        // none of these
};
inline constexpr int kJumpClasses = 4;
const char* ToString(JumpClass kind);

// The class of a jump from `a` to `b`; `before` is the follower that has
// answered `a`, and `pd` what it said.  The step is divided by 32 three times,
// each time where the largest part of the change is.
JumpClass ClassOfJump(Follower before, const Eigen::Vector3d& a,
                      const Eigen::Vector3d& b, const Eigen::Vector3d& pd,
                      double jump, bool has_branches);

}  // namespace phongpd::bench
