// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "constraints/trajectory.h"
#include "planners/trajectory/joint_curves.h"

namespace phongpd::internal {

// Other motions to begin with: as on a roundabout all turn the same way.  Each
// robot goes in the same time along half an ellipse to the right of its
// straight way,
//
//   q(s) = m − e cos πτ + w r sin πτ,   τ = 10s³ − 15s⁴ + 6s⁵,
//
// from m − e to m + e, `lane` = w wide; r is across e and the direction of
// space that starts and goals are spread along least.  Robots that change
// places with those across a circle keep their order around it.  Within the
// limits; whether they are free is for others to say.
std::vector<Trajectory> TurnedMotions(const std::vector<JointRobot>& robots,
                                      double lane);

}  // namespace phongpd::internal
