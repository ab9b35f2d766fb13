// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Triangles a page draws without getting slow.
inline constexpr std::size_t kMaxDisplayTriangles = 200000;
// What a page takes for its probe, in doubles: some 45 bytes a triangle.
inline constexpr std::size_t kMaxProbeTriangles = 100000;
// What a page takes for its solver, which judges motions by them.
inline constexpr std::size_t kMaxSolverTriangles = 10000;

// Edges of what a planner grew that are drawn.
inline constexpr std::size_t kMaxDisplayEdges = 50000;

struct DisplayMesh {
  TriangleMesh mesh;
  double cell = 0.0;  // edge of the grid, user's unit; 0: the mesh as it is
};

// A mesh of at most `most` ≥ 1 triangles to look at, not to compute with:
// vertices in one cell of a grid become one, their mean (vertex clustering,
// Rossignac and Borrel 1993), and triangles with two corners in one cell, or
// that are there already, go.  Any triangles will do; the result may be open
// or cross itself.  No vertex moves farther than √3 cells.
DisplayMesh MeshForDisplay(const TriangleMesh& mesh, std::size_t most);

}  // namespace phongpd
