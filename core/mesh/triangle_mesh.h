// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

// With -ffast-math, bounds of rounding errors, signed zeros and tests for NaN
// would be wrong.
#if defined(__FAST_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "PhongPD needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace phongpd {

// Three vertex indices, counter-clockwise seen from outside the solid.
using Triangle = std::array<int, 3>;

// An indexed triangle mesh.  Plain data: it may be open, inside out or empty.
// Functions that need more say so, and MakeSolid (core/solid/solid.h) checks
// it.  The functions below require valid indices and finite coordinates.
// Coordinates are in the user's unit.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

// An axis-aligned box.  Empty if `min` > `max` in a component.
struct BoundingBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;

  bool IsEmpty() const { return !(min.array() <= max.array()).all(); }
  // Length of the diagonal, user's unit; 0 if empty.
  double Diagonal() const { return IsEmpty() ? 0.0 : (max - min).norm(); }
  Eigen::Vector3d Center() const { return 0.5 * (min + max); }
};

// The bounding box of the triangles.  Vertices that no triangle uses do not
// count.
BoundingBox ComputeBounds(const TriangleMesh& mesh);

// The volume enclosed by a closed mesh: ⅙ Σ q₀·(q₁×q₂) over the triangles, with
// q relative to the centre of the bounding box.  Negative if the mesh is inside
// out.
double SignedVolume(const TriangleMesh& mesh);

// The sum of the triangles' areas.
double SurfaceArea(const TriangleMesh& mesh);

// The connected components: triangles that share a vertex are in one.  Returns
// the component of each triangle, numbered from 0 in order of appearance, and
// writes the number of components to *count.
std::vector<int> LabelComponents(const TriangleMesh& mesh, int* count);

// For each triangle the indices of its three neighbours: entry k is the one
// across the edge (v_k, v_{k+1 mod 3}), −1 if there is none.  Requires an
// edge-manifold mesh.
std::vector<std::array<int, 3>> TriangleNeighbors(const TriangleMesh& mesh);

// The mesh inside out: the order of every triangle's corners is reversed.
TriangleMesh Reversed(TriangleMesh mesh);

// The mesh with every vertex moved by `offset`.
TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3d& offset);

// The mesh with every vertex multiplied by `factor` > 0.
TriangleMesh Scaled(TriangleMesh mesh, double factor);

// The mesh rotated: every vertex v becomes rotation · v.
TriangleMesh Rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation);

// Both meshes in one.  Vertices of a and b at the same place are not joined.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace phongpd
