// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "core/projection/window_use.h"
#include "planners/ompl/motion_domain.h"
#include "planners/solve/optimize.h"

namespace phongpd::internal {

// Can what the request follows be had from windows (window_metric.h)?  Not
// Phong's depth, metrics of one's own, more rows than one a sample, and contact
// spaces of each obstacle.
bool HasWindowMetric(const OptimizeRequest& request);

// TrajectoryPipeline on `problem`, which has no metric, with the one that was
// asked for from windows, and with rrt-connect in `domain` for StartRepair.
// Windows are kept with the world, for further requests; *use is what this one
// added.  Precondition: HasWindowMetric.  Throws what WindowMetric throws.
PipelineResult OptimizeByWindows(const World& world,
                                 const OptimizeRequest& request,
                                 TrajectoryProblem problem,
                                 const MotionDomain& domain,
                                 std::optional<WindowUse>* use);

}  // namespace phongpd::internal
