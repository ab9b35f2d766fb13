// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A mesh in an order that depends on nothing but its geometry.
struct SortedMesh {
  TriangleMesh mesh;
  std::vector<int> source;  // input triangle of each triangle
};

// Vertices that triangles use, sorted by x, y, z; triangles rotated to start
// at their smallest vertex, and sorted.  Distinct vertices of equal coordinates
// keep the input's order among themselves: the one exception.  Valid indices,
// finite coordinates.
SortedMesh SortByCoordinates(const TriangleMesh& mesh);

}  // namespace phongpd
