// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A point of a surface that no other point near it is closer to q than.
struct LocalProjection {
  int triangle = -1;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 0.0;  // user's unit
};

// Buffers that are reused; after a few calls nothing allocates.
struct LocalProjectionScratch {
  std::vector<double> of_triangle, of_vertex;  // squared distances from q
};

// All local minima of x ↦ |x − q| over the closed mesh, at most `bound` away,
// nearest first: what Euclidean projection has, as the Phong field has its
// branches.  The foot in a face, a foot on an edge that both its faces agree
// on, a vertex that all faces around it agree on.  One where minima of equal
// distance touch, give or take rounding.  Looks at every triangle.
//
// `neighbors`: TriangleNeighbors(mesh).  *found is cleared first.
void FindLocalProjections(const TriangleMesh& mesh,
                          const std::vector<std::array<int, 3>>& neighbors,
                          const Eigen::Vector3d& q, double bound,
                          LocalProjectionScratch* scratch,
                          std::vector<LocalProjection>* found);

}  // namespace phongpd
