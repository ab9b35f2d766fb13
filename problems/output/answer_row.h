// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// What a path without limits followed: the metric's name, its own if it is the
// caller's, or "corridor", where there was none.  For rows, and for people.
std::string MethodName(const OptimizeRequest& request,
                       const PathAnswer& answer);
std::string MethodTitle(const OptimizeRequest& request,
                        const PathAnswer& answer);

// An answer as one row of results, with the keys that the command line
// documents.  The scene gives its name and unit.
nlohmann::ordered_json PlanRow(const Scene& scene, const World& world,
                               const PlanRequest& request,
                               const PathAnswer& answer);
// Of a request without limits, and of one with them.
nlohmann::ordered_json PolylineRow(const Scene& scene, const World& world,
                                   const OptimizeRequest& request,
                                   const PathAnswer& answer);
nlohmann::ordered_json MotionRow(const Scene& scene, const World& world,
                                 const OptimizeRequest& request,
                                 const PathAnswer& answer);

}  // namespace phongpd
