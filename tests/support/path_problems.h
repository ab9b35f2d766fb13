// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Families of contact spaces with a start and a goal whose straight line
// collides: what start repair, corridor and optimiser are tested on.
namespace phongpd::testing {

struct PathProblem {
  TriangleMesh contact;  // turned by one generic rotation
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
};

// Names of the families: Uaxis (through both arms of a U), U, L, plate0.1,
// plate0.02, plate0.005 (by thickness), longplate (path along it), hole (plate
// with a hole, path near it), torus, cone_axes, ball_wrench, clutter (union of
// 20 boxes), channel0.1, channel0.01, channel0.001 (through a block, by
// width).
std::vector<std::string> PathFamilies();

// The same contact space for every seed (clutter: one of six); the ends are
// free, at least 0.02 diagonals away from it, and differ by seed.
PathProblem MakePathProblem(const std::string& family, std::uint64_t seed);

// Of a cube of side 2 in a vessel whose cavity has side 6: q in [−2, 2]³, and
// around the vessel, of side 10, q outside [−6, 6]³.
TriangleMesh VesselSpace();

}  // namespace phongpd::testing
