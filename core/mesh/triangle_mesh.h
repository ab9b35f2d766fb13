// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

// Proofs by rounding errors, signed zeros and NaN checks are void under it.
#if defined(__FAST_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "PhongPD needs IEEE arithmetic: compile without -ffast-math"
#endif

namespace phongpd {

// Three vertex indices, counter-clockwise seen from outside the solid.
using Triangle = std::array<int, 3>;

// An indexed triangle mesh: plain data, no invariant of its own.  What a
// function needs of a mesh (closed, outward, ...) its contract says;
// mesh_check.h establishes it.  The functions below require valid indices
// and finite coordinates.  Coordinates are in the user's unit.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Triangle> triangles;
};

// Axis-aligned box; `min` > `max` componentwise when it holds no point.
struct BoundingBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;

  bool IsEmpty() const { return !(min.array() <= max.array()).all(); }
  // Length of the diagonal in the mesh's unit; 0 when empty.
  double Diagonal() const { return IsEmpty() ? 0.0 : (max - min).norm(); }
  Eigen::Vector3d Center() const { return 0.5 * (min + max); }
};

// Bounding box of the vertices that triangles use.
BoundingBox ComputeBounds(const TriangleMesh& mesh);

// Volume enclosed by a closed mesh, ⅙ Σ q₀·(q₁×q₂) taken relative to the
// centre of the bounding box; negative when the mesh is inside out.
double SignedVolume(const TriangleMesh& mesh);

// Total area of the triangles.
double SurfaceArea(const TriangleMesh& mesh);

// Labels the vertex-connected components of the triangles with 0, 1, ... in
// order of first appearance.  Returns the label of each triangle; the number
// of components is written to *count.
std::vector<int> LabelComponents(const TriangleMesh& mesh, int* count);

// The neighbour across edge k = (v_k, v_{k+1 mod 3}) of each triangle, or −1
// on a boundary.  Requires an edge-manifold mesh.
std::vector<std::array<int, 3>> TriangleNeighbors(const TriangleMesh& mesh);

// The mesh inside out: every triangle turned over.
TriangleMesh Reversed(TriangleMesh mesh);

// The mesh with every vertex moved by `offset`.
TriangleMesh Translated(TriangleMesh mesh, const Eigen::Vector3d& offset);

// The mesh with every vertex multiplied by `factor` > 0.
TriangleMesh Scaled(TriangleMesh mesh, double factor);

// The mesh rotated: every vertex v becomes rotation · v.
TriangleMesh Rotated(TriangleMesh mesh, const Eigen::Matrix3d& rotation);

// Both meshes as one; what touches stays apart.
TriangleMesh Joined(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace phongpd
