// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A mesh in place of another one, and how far it is from it.
struct ApproximateMesh {
  TriangleMesh mesh;  // a solid, as MakeSolid gives it
  // Upper bound, user's unit, of the Hausdorff distance between the two
  // SOLIDS (interior points included): proved by branch and bound up to the
  // rounding of double, not sampled (solid_distance.h).
  double bound = 0.0;
  // The same distance is at least this; tells how sharp the bound is.
  double lower_bound = 0.0;
  bool is_conservative = true;  // contains all of the given solid
  std::string note;             // what a user should know; may be empty
};

// A bound of the solid says nothing about what is thinner than it: a slot, a
// tunnel, a cavity or a wall narrower than about twice the bound may vanish
// or appear.  The Hausdorff distance of two Minkowski sums is at most the sum
// of the operands' distances, so bounds of several steps and of both operands
// add up.

// Convex hull of a solid.  Of a convex solid it is the solid itself, the
// bound then is rounding.
ApproximateMesh ConvexHull(const TriangleMesh& solid);

// Edge collapse (Lindstrom and Turk 1998) of a solid to about `target_faces`
// ≥ 4 triangles; never a conservative one.  Collapses that make the mesh cross
// itself are taken back, so that there may be more triangles than asked for:
// the note says so.  A mesh that has no more than asked for comes back as it
// is.  Throws InputError for target_faces < 4.
ApproximateMesh Decimate(const TriangleMesh& solid, std::size_t target_faces);

// Alpha wrap (Portaneri et al. 2022) of a solid: encloses it strictly, closes
// tunnels and pockets narrower than about 2 · alpha, fills cavities.  `alpha`
// and the offset, a tenth of it, are fractions of the mesh's diagonal.
// Throws InputError unless alpha is in [1/500, 1].
ApproximateMesh WrapSolid(const TriangleMesh& solid, double alpha);

// The same for triangles that are no solid: open, crossing, of any
// orientation.  They bound nothing, so the bound is that of the surfaces, and
// one way: no point of the wrap is farther from a triangle of the input.
// Requires finite coordinates, valid indices and one triangle with an area.
ApproximateMesh WrapTriangles(const TriangleMesh& mesh, double alpha);

// Coarsest and finest wrap that is offered: the time grows with 1/alpha².
inline constexpr double kMinWrapAlpha = 1.0 / 500.0;
inline constexpr double kMaxWrapAlpha = 1.0;

}  // namespace phongpd
