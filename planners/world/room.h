// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/world/workspace.h"

namespace phongpd {

// How far the robot at q is from the nearest obstacle or bound, user's unit:
// the most that any path through q keeps.  0 where q is not free.  Of the
// solids themselves, with no contact space; rounded.  Throws InputError if q is
// not finite.
double Room(const Workspace& workspace, const Eigen::Vector3d& q);

}  // namespace phongpd
