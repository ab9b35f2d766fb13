// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planners/rigid/rigid_plan.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "viewer/view.h"

// The paths of runs, as pages show them.
namespace phongpd::cli {

// The path of an answer, named by its planner or method, seed and status
// ("PhongPD, ℓ = 0.2 · seed 0 · solved"); of Optimize, without limits.
NamedPath NamedPathOf(const PlanRequest& request, const PathAnswer& answer);
NamedPath NamedPathOf(const OptimizeRequest& request, const PathAnswer& answer);
NamedPath NamedPathOf(const RigidRequest& request, const RigidAnswer& answer);

// The same of a row that optimize or plan wrote, for those who have no answer:
// of files that are looked at, and of an interrupted command.  Throws
// nlohmann::json::exception for what is none, and InputError for poses.
NamedPath NamedPathOf(const nlohmann::ordered_json& row);

}  // namespace phongpd::cli
