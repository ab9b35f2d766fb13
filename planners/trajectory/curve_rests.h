// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/curve_optimizer.h"

namespace phongpd::internal {

// Is a place on the way rested at?
bool HasRests(const CurveOptions& options);

// OptimizeCurve where options.via has places to rest at, each a point of the
// path: one curve after the other, from rest to rest between them.  Where two
// places, or one and an end at rest, are the same there is no curve between.
CurveSummary OptimizeWithRests(const FreeSpace& space, double diagonal,
                               const std::vector<Eigen::Vector3d>& path,
                               const CurveOptions& options);

}  // namespace phongpd::internal
