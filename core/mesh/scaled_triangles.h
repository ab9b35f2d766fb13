// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <vector>

#include "core/mesh/box_tree.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The triangles of a mesh as a tree for distances wants them: about the origin
// and of a size whose squares neither over- nor underflow, x' = (x − c)·s with
// c the centre of the bounding box and s the power of two that brings its
// diagonal into [1, 2).  Valid indices, finite coordinates.
struct ScaledTriangles {
  using Corners = std::array<Eigen::Vector3d, 3>;

  explicit ScaledTriangles(const TriangleMesh& mesh) {
    const BoundingBox bounds = ComputeBounds(mesh);
    center = bounds.Center();
    const double diagonal = bounds.Diagonal();
    if (diagonal > 0.0) scale = std::ldexp(1.0, -std::ilogb(diagonal));
    std::vector<Corners> unsorted;
    std::vector<BoundingBox> boxes;
    for (const Triangle& t : mesh.triangles) {
      Corners q;
      for (std::size_t k = 0; k < 3; ++k) {
        q[k] = (mesh.vertices[t[k]] - center) * scale;
      }
      unsorted.push_back(q);
      boxes.push_back({q[0].cwiseMin(q[1]).cwiseMin(q[2]),
                       q[0].cwiseMax(q[1]).cwiseMax(q[2])});
    }
    tree = BoxTree(boxes, 2);
    for (const int item : tree.order()) corners.push_back(unsorted[item]);
  }

  Eigen::Vector3d center;
  double scale = 1.0;
  BoxTree tree;
  std::vector<Corners> corners;  // in the tree's order
};

}  // namespace phongpd
