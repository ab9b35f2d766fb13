// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/world/path_status.h"
#include "planners/world/workspace.h"

namespace phongpd::cli {

// Which end of a path it says to be in collision: "start", "goal", or "".
std::string CollidingEnd(PathStatus status);

// "triangle 3 of the robot meets triangle 12 of wall", of a robot that
// translates at q; empty where no two of them are seen to meet.  Exact
// (rigid_judge.h); numbers as in the meshes.
std::string TrianglesThatMeet(const Workspace& workspace,
                              const Eigen::Vector3d& q);

}  // namespace phongpd::cli
