// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::testing {

// A cube of side 1 − δ among the filled cells of a block of unit cells, with
// one more layer around them, filled or free.  The robot moves from cell to
// cell through faces only, so flood fill tells which cells are connected.
//
// The contact space is known in closed form: the closed cells widened by half
// the robot, in a lattice of steps δ and 1 − δ.
struct VoxelWorld {
  TriangleMesh contact_space;
  std::vector<Eigen::Vector3d> centers;  // of the free cells
  std::vector<int> labels;               // of their connected parts
};

// A block of n³ cells.  0 < channel = δ < 1.
VoxelWorld MakeVoxelWorld(int n, double fill, double channel,
                          bool filled_around, std::mt19937_64* random);

}  // namespace phongpd::testing
