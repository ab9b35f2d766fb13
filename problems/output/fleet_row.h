// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "planners/solve/fleet.h"
#include "problems/scenes/fleet_scene.h"

namespace phongpd {

// The robots of a scene as OptimizeFleet takes them: equal ones share a world,
// of scene and `limits`; requests are those of their scenes.
std::vector<FleetRobot> RobotsOf(const FleetScene& scene,
                                 const ContactSpaceCache& cache,
                                 const WorldLimits& limits);

// The answer as one row of results: what holds for all, every pair, and of each
// robot its MotionRow behind its `id`.
nlohmann::ordered_json FleetRow(const FleetScene& scene,
                                const std::vector<FleetRobot>& robots,
                                const FleetAnswer& answer);

}  // namespace phongpd
