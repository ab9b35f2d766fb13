// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "planners/trajectory/knot_curve.h"

// How a curve that does not begin at rest comes to rest, within the limits.
// Ends are beginnings backwards in time.
namespace phongpd::internal {

bool IsAtRest(const KnotCurve::State& state);

// From the last state to the first, with velocities turned.
KnotCurve Backwards(const KnotCurve& curve);
// `second` begins where `first` ends.
KnotCurve Joined(const KnotCurve& first, const KnotCurve& second);

// Stops by constant jerks, each at the limit: straight along the velocity that
// is left when the acceleration has gone, which is the shortest such stop where
// both are parallel; and, of limits by axis, each axis alone in its least time.
// Limits that are not there are replaced by such as stop within about `length`.
std::vector<KnotCurve> StopsFrom(const KnotCurve::State& state,
                                 const MotionLimits& limits, double length);

struct Stop {
  KnotCurve curve;                    // to rest; no knots: at rest already
  std::vector<Eigen::Vector3d> path;  // free, from there to the path's end
};
// The first of the stops, or of the motions to rest at some place of the path,
// that is free, and what leads on from there.  If there is none, throws
// InputError that says how long the straight stop is, and how much of it is
// free: of the motion's start, or of its end, seen backwards in time.
// `state.p` is where the free `path` begins.
Stop FindStop(const FreeSpace& space, double diagonal,
              const KnotCurve::State& state,
              const std::vector<Eigen::Vector3d>& path,
              const MotionLimits& limits, bool is_end);

}  // namespace phongpd::internal
