// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <random>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/shapes/random_solids.h"

// Unions of boxes on a lattice, whose Minkowski sums have volumes that counting
// cells tells.
namespace phongpd {

// An axis-aligned box [min, max] with corners on the lattice of quarters:
// coordinates are in quarters of a unit.
struct LatticeBox {
  std::array<int, 3> min;
  std::array<int, 3> max;
};

// The cells as boxes of the lattice.
std::vector<LatticeBox> LatticeBoxes(const Voxels& voxels);

// Every box as a component of its own: they may overlap, and touch in faces,
// edges and vertices.
TriangleMesh BoxesMesh(const std::vector<LatticeBox>& boxes);

// Volume of { b − a } over all points of two unions of boxes: the contact
// space's by counting cells, in the unit cubed.
double LatticeSumVolume(const std::vector<LatticeBox>& robot,
                        const std::vector<LatticeBox>& obstacle);

}  // namespace phongpd
