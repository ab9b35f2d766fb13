// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_corners.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The triangles of a mesh as a tree for distances wants them: about the origin
// and of a size whose squares neither over- nor underflow, x' = (x − c)·s with
// c the centre of the bounding box and s the power of two that brings its
// diagonal into [1, 2).  Valid indices, finite coordinates.
struct ScaledTriangles {
  explicit ScaledTriangles(const TriangleMesh& mesh) {
    const BoundingBox bounds = ComputeBounds(mesh);
    center = bounds.Center();
    const double diagonal = bounds.Diagonal();
    if (diagonal > 0.0) scale = std::ldexp(1.0, -std::ilogb(diagonal));
    corners = CornersOf(mesh);
    for (TriangleCorners& q : corners) {
      for (Eigen::Vector3d& x : q) x = (x - center) * scale;
    }
    tree = SortIntoTree(&corners);
  }

  Eigen::Vector3d center;
  double scale = 1.0;
  BoxTree tree;
  std::vector<TriangleCorners> corners;  // in the tree's order
};

}  // namespace phongpd
