// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/triangle_mesh.h"

// Other ways to the boundary of B ⊕ (−A), from CGAL.  Each function lives in
// a source of its own: their headers take long to compile.  They may run for
// hours or throw; call them in a process with a limit.
namespace phongpd::bench {

struct CompetitorResult {
  std::size_t triangles = 0;  // a polygon of n corners counts n − 2
  double volume = 0.0;
};

// Nef polyhedra: minkowski_sum_3 (decomposes into convex parts, unites the
// sums of the parts).
CompetitorResult NefSum(const TriangleMesh& robot,
                        const TriangleMesh& obstacle);

// Convex parts (an operand convex up to rounding is one, others go through
// convex_decomposition_3), the hull of every pair's vertex
// sums, and their union by PMP corefinement on exact constructions, pair by
// pair up a tree.
CompetitorResult HullUnion(const TriangleMesh& robot,
                           const TriangleMesh& obstacle);

}  // namespace phongpd::bench
