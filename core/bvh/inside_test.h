// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

enum class Location { kOutside, kOnSurface, kInside };

// Where a point lies relative to the solid a closed mesh bounds: exact, in
// the user's own coordinates (no frame change, hence no rounding).
//
// Parity of the crossings of a vertical ray from q.  Ties are removed by
// symbolic perturbation: the ray starts at (x + ε, y + ε², z) with an
// infinitesimal ε > 0, so it never meets an edge or a vertex, vertical
// triangles never count, and no second ray is ever needed.  The surface
// itself is found without perturbation: q lies on a triangle when the exact
// signs say so.
//
// Crossing parity is the inside of closed meshes that do not self-intersect.
class InsideTest {
 public:
  InsideTest() = default;
  // Finite coordinates; degenerate triangles are harmless.
  explicit InsideTest(const TriangleMesh& mesh);

  // kOutside for non-finite q.
  Location Locate(const Eigen::Vector3d& q) const;

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  BoxTree tree_;
  std::vector<Corners> corners_;  // in the tree's order
};

}  // namespace phongpd
