// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// One edge {i, j} of the intrinsic triangulation; i == j for a loop, and the
// same pair may occur more than once: weights add up.
struct CotangentWeight {
  int i;
  int j;
  double weight;  // ½ (cot α + cot β) ≥ 0, α and β opposite the edge
};

// Cotangent weights of the intrinsic Delaunay triangulation of a closed,
// edge-manifold, consistently oriented mesh (Bobenko and Springborn 2007):
// edges are flipped inside the surface, without moving it, until α + β ≤ π
// everywhere.  The Laplacian of the surface becomes the same whichever way its
// flat patches were cut into triangles (up to vertices), and has no negative
// weight.
//
// Lengths are first increased by one common amount such that every triangle
// inequality has a slack of 1e-10 × the bounding box's diagonal ("intrinsic
// mollification", Sharp and Crane 2020) and cotangents are cut off at ±1e6, so
// degenerate triangles and coincident vertices do no harm.
std::vector<CotangentWeight> IntrinsicDelaunayWeights(const TriangleMesh& mesh);

}  // namespace phongpd
