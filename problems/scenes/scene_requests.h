// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// What a scene asks of Plan and Optimize in its world, which is one of
// scene.workspace.  Settings that are not in the scene are the requests' own.
PlanRequest PlanRequestOf(const Scene& scene);
OptimizeRequest OptimizeRequestOf(const Scene& scene);

}  // namespace phongpd
