// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// Edges of a closed, edge-manifold, consistently oriented mesh.
struct EdgeTable {
  std::vector<std::array<int, 2>> vertices;        // smaller index first
  std::vector<std::array<int, 2>> triangles;       // smaller index first
  std::vector<std::array<int, 3>> triangle_edges;  // edge k: v_k to v_{k+1}
};

// Numbers the edges in the order of their vertex pairs.  An edge with other
// than two triangles of opposite direction is counted in *bad_edges; with any,
// the table is incomplete.
EdgeTable MakeEdgeTable(const std::vector<Triangle>& triangles,
                        std::size_t* bad_edges);

// Splits the marked edges at their mid-points, in the triangles on both sides:
// of a triangle's marked edges the longest is bisected first, and the two
// halves then in the same way (at most four triangles from one; ties go to the
// smaller pair of vertices).  `source` (per triangle) is handed down to the
// parts; mid-points are appended to the vertices in the order of the edges.
// Returns the new vertex of each edge, or -1.
//
// The mid-point is rounded: it lies off its edge by at most 2^-54 × the
// largest power of two ≤ 2 |coordinate| in each coordinate, i.e. ≤ 2^-54 in
// the field frame, on top of what the ends are off.
std::vector<int> SplitEdges(const EdgeTable& edges,
                            const std::vector<char>& marked, TriangleMesh* mesh,
                            std::vector<int>* source);

}  // namespace phongpd
