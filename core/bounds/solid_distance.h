// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// How hard to search.  The search stops when upper ≤ (1 + relative) · lower,
// when upper − lower ≤ absolute · diagonal, or out of budget; the bounds hold
// in every case, only the last one leaves them further apart.
struct DistanceSearch {
  double relative = 0.1;
  double absolute = 1e-3;       // of the diagonal of both meshes together
  std::size_t budget = 400000;  // pieces examined beyond the initial ones
};

// lower ≤ h ≤ upper for a largest distance h, user's unit.
struct DistanceBounds {
  double lower = 0.0;
  double upper = 0.0;
  std::size_t pieces = 0;  // examined
};

// All functions bound h = sup { d(x, Y) : x ∈ X }, one direction of a
// Hausdorff distance, by branch and bound; proved up to the rounding of
// double, 1e-14 of the diagonal, which is added.  Meshes: finite, at least
// one triangle.
//  - Triangles T of the surface of X, centre c, radius r, S the triangle of Y
//    closest to c:  sup d(T, Y) ≤ min( d(c, Y) + r,  max_k d(v_k, S) ), as the
//    distance to a set has Lipschitz constant 1 and to a convex set is convex.
//  - A maximum inside X is a local one of d(·, Y), so its closest points on Y
//    are seen on all sides.  A tetrahedron cannot hold it when all facets of
//    Y that are near enough face one way, n·N > 0.  The others are cut until
//    d(c, Y) + r is small enough.

// X, Y: the solids bounded by two closed, outward meshes without
// self-intersection within a component (MakeSolid gives such).  Components
// may overlap, their union is meant.  Interior points count: a filled cavity
// is as far as its middle, although no surface moved.
DistanceBounds SolidDeviation(const TriangleMesh& from, const TriangleMesh& to,
                              const DistanceSearch& search = {});

// X, Y: the surfaces.
DistanceBounds SurfaceDeviation(const TriangleMesh& from,
                                const TriangleMesh& to,
                                const DistanceSearch& search = {});

// X: the convex `hull` of the solid Y.  Tight also where hull and solid are
// the same up to rounding.
DistanceBounds HullDeviation(const TriangleMesh& hull, const TriangleMesh& to,
                             const DistanceSearch& search = {});

}  // namespace phongpd
