// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "constraints/free_space.h"
#include "constraints/trajectory.h"
#include "planners/trajectory/curve_cells.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"

// How a curve that was moved comes to keep its limits again.
namespace phongpd::internal {

// So much of a step (CurveStep::change).  Inner states slow down with the times
// about them: with γ the mean of η of both pieces, v + Δv is, to first order,
// (v + Δv + γv) e^−γ, and so for a with 2γ.  Bézier points are p ± h v/5 and
// such: they then differ from the first order by products with differences of η
// alone, and where all goes faster by nothing.
KnotCurve Moved(const KnotCurve& curve, const KnotCurve& change, double share);

// Of each piece, by the margin and the trust of the options.
std::vector<PieceCells> CellsOf(const FreeSpace& space, const KnotCurve& curve,
                                const CurveProgramOptions& options);

// So much of a step, slowed so that the limits hold; where the pace is kept,
// so much that they do, or `now`.
KnotCurve MovedWithinLimits(const FreeSpace& space, const KnotCurve& now,
                            const KnotCurve& change, double share,
                            const CurveProgramOptions& options);

// Slows it to the least time at which it keeps the limits, proved.  With an end
// in motion by no more than rounding: false if that is not enough, or if
// rounding cannot be got rid of.
bool FitTime(const MotionLimits& limits, bool is_at_rest,
             Trajectory* trajectory);

}  // namespace phongpd::internal
