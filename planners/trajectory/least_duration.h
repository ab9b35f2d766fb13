// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/trajectory.h"

namespace phongpd {

// Seconds that no motion by this way q1 − q0 can fall below, whatever is in its
// way: of the slowest axis as if it were alone, or, if limits are of the norm,
// of the straight line.  From rest to rest: in closed form, of at most seven
// phases, those at the limit of velocity, then of acceleration, being left out
// where the way is too short for them.  Otherwise at the limit of velocity.
// `way` is finite, in the unit of length of the limits, which are valid.
double LeastDuration(const Eigen::Vector3d& way, const MotionLimits& limits,
                     bool from_rest_to_rest);

}  // namespace phongpd
