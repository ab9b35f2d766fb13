// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// The requests that a scene makes to Plan and Optimize in the world of
// scene.workspace:
//
//   PathAnswer answer = Plan(World(scene.workspace), PlanRequestOf(scene));
//
// Settings that a scene does not have keep the requests' defaults.
PlanRequest PlanRequestOf(const Scene& scene);
OptimizeRequest OptimizeRequestOf(const Scene& scene);

}  // namespace phongpd
