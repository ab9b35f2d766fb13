// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A mesh in the frame of PhongField and in an order that depends on nothing
// but its geometry (sorted_mesh.h).  Whatever is computed from it is
// independent, to the last bit, of the order of the input's vertices and
// triangles.
struct CanonicalMesh {
  TriangleMesh mesh;
  std::vector<int> source;  // input triangle of each triangle
  Eigen::Vector3d center;   // of the input's bounding box
  double scale = 1.0;       // power of two
  double diagonal = 1.0;    // of the bounding box, in [1, 2) after scaling
};

// Of the mesh of a contact space: finite, closed, oriented, of a diagonal in
// [1e-150, 1e150].
CanonicalMesh MakeCanonical(const TriangleMesh& mesh);

}  // namespace phongpd
