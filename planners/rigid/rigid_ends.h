// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "planners/rigid/rigid_plan.h"
#include "planners/rigid/tree_search.h"

namespace phongpd::internal {

// Those of the request, or as it says where these are empty.
Eigen::AlignedBox3d BoundsOf(const RigidWorld& world,
                             const RigidRequest& request);

// Are start and goal free and within the bounds?  If not, status, reason,
// collision and depth of the answer say why.
bool AreEndsFree(const RigidWorld& world, const TreeTask& task,
                 RigidAnswer* answer);

// Puts back what rounding put out of the bounds; then the judge's second pass,
// of every motion of the path that is handed out: its length and clearance.
// False, the path gone and kNotCertified, where one is not free.
bool ConfirmPath(const RigidWorld& world, const Eigen::AlignedBox3d& bounds,
                 RigidAnswer* answer);

}  // namespace phongpd::internal
