// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The corners of a triangle, at hand where a search visits it.
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

// Of all triangles, in their order.
std::vector<TriangleCorners> CornersOf(const TriangleMesh& mesh);

// A tree over the boxes of the triangles, at most two in a leaf; sorts them
// into its order.  Finite coordinates.
BoxTree SortIntoTree(std::vector<TriangleCorners>* corners);

}  // namespace phongpd
