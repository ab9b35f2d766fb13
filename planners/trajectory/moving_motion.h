// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/moving_judge.h"
#include "planners/trajectory/curve_optimizer.h"

// How a robot gets through between things that move.
namespace phongpd::internal {

struct MovingTask {
  const FreeSpace& fixed;
  const std::vector<MovingBody>& bodies;
  BoundingBox bounds;           // of q; empty: none
  double diagonal = 0.0;        // D
  const CurveOptions& options;  // at rest at both ends, no duration
  bool margin_is_required = false;
};

// A way from start to goal, and a fast motion along it that is free of what is
// fixed (OptimizeCurve).
struct FixedMotion {
  std::vector<Eigen::Vector3d> path;
  Trajectory motion;
};

// What was found, certified: CheckCurveAmong, and within the limits.
struct MovingMotion {
  Trajectory motion;          // empty: nothing was found
  std::size_t way = 0;        // that it was sought along
  double clearance = 0.0;     // ProvedClearance, up to the margin
  bool is_cut_short = false;  // by the time limit, or from outside
};

// In this order, and the fastest of it:
//
//  1. The motions as they are.  The fastest one is the answer if it is free,
//     and so is what takes a fiftieth longer, when that is found.
//  2. Motions begun later, or slower, with rests at corners of their paths and
//     between them, straight from rest to rest (timed_roads.h).
//  3. The same with places beside the paths, to make way.
//  4. Of the best of these: what leads from rest to rest made fast by
//     OptimizeCurve, rests left out where that is free, begun as early as can
//     be.
//
// With the margin as distance from what moves; if there is none like that, and
// it is not required, without.  With places on the way (options.via) rests are
// only made before the motion begins.  A search, not a proof that there is no
// other motion, nor that none is faster.
MovingMotion FindMotionAmong(const MovingTask& task,
                             const std::vector<FixedMotion>& ways);

}  // namespace phongpd::internal
