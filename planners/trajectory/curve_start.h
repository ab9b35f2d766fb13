// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/free_space.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {

// The slow curve that the search for a faster one begins with: a stop from the
// start, stops at the path's corners, and a run-up to the end.
struct CurveStart {
  KnotCurve stop;            // no knots: it starts at rest
  KnotCurve stops;           // no knots: nothing is left between the two
  KnotCurve run_up;          // no knots: it ends at rest
  std::vector<ViaKnot> via;  // places, as knots of With(stops)

  // The whole, with `middle`, of as many pieces, instead of the stops.
  KnotCurve With(const KnotCurve& middle) const;
  // The places as knots of `stops` alone.
  std::vector<ViaKnot> ViaOfStops() const;
};

// `path` is free, and has the points of options.via in their order.  Throws
// InputError where the robot cannot stop in time (curve_ends.h).
CurveStart FindCurveStart(const FreeSpace& space, double diagonal,
                          const std::vector<Eigen::Vector3d>& path,
                          const CurveOptions& options);

}  // namespace phongpd::internal
