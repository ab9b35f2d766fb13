// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/contact/contact_space.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/exact/workspace.h"

namespace phongpd {

struct ExactSolution {
  PlanResult plan;
  ContactSpaceReport contact_space;
  double contact_space_seconds = 0.0;
  double planner_seconds = 0.0;  // building the planner, not the query
};

// Plans a problem from the solids on: the contact space of the robot and
// MergedObstacle, then one query.  For several queries keep the planner.
// Throws InputError for workspaces, options and solids that are none.
// A start or goal that is not free is explained with the obstacle's id,
// "bounds" for the bounds.
ExactSolution SolveExactly(const Workspace& workspace,
                           const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal,
                           const ContactSurfaceOptions& options = {},
                           const ContactSpaceOptions& contact_options = {});

// The ids of what the robot touches at q: obstacles, and "bounds"; separated
// by ", ".  Decided exactly, on the solids.
std::string NameObstacles(const Workspace& workspace, const Eigen::Vector3d& q);

}  // namespace phongpd
