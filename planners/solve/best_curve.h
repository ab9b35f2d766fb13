// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "constraints/free_space.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/trajectory_problem.h"

namespace phongpd::internal {

struct BestCurve {
  CurveSummary summary;  // its seconds are those of all of them together
  std::size_t path = 0;  // that it began with
  int tried = 0;  // of the paths: the others came too late, or would lose
  std::vector<Trajectory> motions;  // by path, as far as each came; empty: none
};

// OptimizeCurve from the best `refined` of several free paths with the same
// ends, side by side, and the best of what they come to: a motion that keeps a
// required margin before one that does not; then the least cost, which is time
// and what is missing of the margin, or of a given duration the least jerk.
//
// Which paths are the best is seen by the cost of what kFast makes of them.  If
// one is refined, the first is looked at before the others; of these only what
// may be better is: no path that is hardly another way, too long, or of more
// than 32 corners, and none where the first one is near the least time that any
// could take.  Where a duration is given or a margin required, or the motion
// rests on its way, the first ones are taken.
//
// A path whose turn comes when time is up is left out, too, but for the first.
// options.is_interrupted is asked by one thread at a time.
BestCurve OptimizeAlongBest(const FreeSpace& space, double diagonal,
                            const std::vector<Path>& paths,
                            const CurveOptions& options,
                            bool margin_is_required, int refined);

// ∫ |q'''|² dt, each axis as a share of its limit; of pieces of degree 5 at
// most.
double SquaredJerk(const Trajectory& trajectory, const MotionLimits& limits);

}  // namespace phongpd::internal
