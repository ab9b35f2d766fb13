// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planners/rigid/optimizer/rigid_optimize.h"
#include "planners/rigid/rigid_plan.h"
#include "problems/scenes/turning_scene.h"

namespace phongpd {

// The request of a scene as it stands.
RigidRequest RigidRequestOf(const TurningScene& scene);

// Its surfaces.
RigidWorld RigidWorldOf(const TurningScene& scene);

// Who found the path; "none": nobody.
std::string PlannerName(const RigidAnswer& answer);

// The answer as one row of results: docs/outputs.md.
nlohmann::ordered_json RigidRow(const TurningScene& scene,
                                const RigidRequest& request,
                                const RigidAnswer& answer);
// The same of an optimiser's, with its own words after them.
nlohmann::ordered_json RigidOptimumRow(const TurningScene& scene,
                                       const RigidOptimizeRequest& request,
                                       const RigidOptimum& found);

}  // namespace phongpd
