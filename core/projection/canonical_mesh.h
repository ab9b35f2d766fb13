// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A mesh in the frame of PhongField and in an order that depends on nothing
// but its geometry: used vertices sorted by coordinates, triangles rotated to
// start at their smallest vertex and sorted.  Whatever is computed from it is
// independent, to the last bit, of the order of the input's vertices and
// triangles.  (Distinct vertices of equal coordinates keep the input's order
// among themselves: the one exception.)
struct CanonicalMesh {
  TriangleMesh mesh;
  std::vector<int> source;  // input triangle of each triangle
  Eigen::Vector3d center;   // of the input's bounding box
  double scale = 1.0;       // power of two
  double diagonal = 1.0;    // of the bounding box, in [1, 2) after scaling
};

// Requires finite, closed, edge-manifold and consistently oriented input with
// a bounding box of normal, positive diagonal; throws InputError otherwise.
CanonicalMesh MakeCanonical(const TriangleMesh& mesh);

}  // namespace phongpd
