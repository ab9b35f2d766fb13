// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// From start straight out to a box that holds everything, over its surface,
// and straight in to the goal: free, because both ends of every piece lie on
// one side of a plane that has `inner` on the other.  Empty if start or goal
// is not outside `inner`.
std::vector<Eigen::Vector3d> PathAround(const Eigen::Vector3d& start,
                                        const Eigen::Vector3d& goal,
                                        const BoundingBox& inner);

}  // namespace phongpd
