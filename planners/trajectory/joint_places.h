// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "constraints/trajectory.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/joint_program.h"
#include "planners/trajectory/knot_curve.h"

// Places on the way of curves with knots in common.
namespace phongpd::internal {

// A knot that stays close to a place, or those between which the curve rests
// there.
struct JointPlace {
  CurveVia via;
  // Knots; different if via.dwell > 0.  `last` may be the curve's last one.
  int first = 0, last = 0;
};

struct JointKnots {
  std::vector<double> times;
  std::vector<std::vector<JointPlace>> places;  // of each curve, in order
};

// Knots at even times, but for those nearest to what a motion passes, which are
// when it does: as many pieces, and some more where two such times are close.
// None: a motion does not pass its places at its joints, or the times are so
// close that pieces would be shorter than a quarter of the even ones.  `via`:
// of each motion.
std::optional<JointKnots> JointKnotsOf(
    const std::vector<Trajectory>& motions,
    const std::vector<std::vector<CurveVia>>& via, double duration, int pieces);

// The knots of a curve's places where they belong, but for what the rows leave
// of rounding; where it rests, at rest.
void PutIntoPlaces(const std::vector<JointPlace>& places, KnotCurve* curve);

// The factor by which a curve has to be slowed to rest as long as is asked for.
double SlowingOfRests(const std::vector<JointPlace>& places,
                      const KnotCurve& curve);

// Knots at which it rests.
std::vector<int> RestingKnots(const std::vector<JointPlace>& places);

// Rows of those rests: no piece of one loses more of its time than it has to
// spare.
std::vector<JointProgram::Row> RowsOfRests(
    const std::vector<JointPlace>& places, const KnotCurve& curve);

}  // namespace phongpd::internal
