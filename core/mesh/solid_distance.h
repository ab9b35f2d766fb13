// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

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
// Hausdorff distance, by branch and bound.  X is covered by tetrahedra or
// triangles T with centre c and radius r; each is cut in two until
//   sup { d(x, Y) : x ∈ T } ≤ min( d(c, Y) + r,  max_k d(v_k, S) )
// is small enough, where S is the triangle of Y closest to c: the distance to
// a point set has Lipschitz constant 1, that to a convex set is convex.
// The bounds are proved up to the rounding of double, 1e-14 of the diagonal,
// which is added.  Meshes: finite, at least one triangle.

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

// As SolidDeviation, for two solids of which one surface moves onto the
// other: `track` is closed, and its triangles with every vertex i moved to
// images[i] make up the other surface (triangles may collapse).  The straight
// tracks of all triangles, three tetrahedra each, sweep whatever the solids
// differ in, so only those are searched: far tighter where little moves.
DistanceBounds SweptDeviation(const TriangleMesh& track,
                              const std::vector<Eigen::Vector3d>& images,
                              const TriangleMesh& from, const TriangleMesh& to,
                              const DistanceSearch& search = {});

// X: the convex `hull` of the solid Y.  Tight also where hull and solid are
// the same up to rounding.
DistanceBounds HullDeviation(const TriangleMesh& hull, const TriangleMesh& to,
                             const DistanceSearch& search = {});

}  // namespace phongpd
