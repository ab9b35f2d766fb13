// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Which triangles share an edge, for meshes that need not be manifold.
namespace phongpd::internal {

// A triangle's side of an edge, from its corner `corner` to the next one.
struct EdgeSide {
  int low, high;  // ends of the edge, low ≤ high
  int triangle, corner;
  bool is_forward;  // from low to high
};

enum class FoldedTriangles { kKept, kLeftOut };  // that use a vertex twice

// All sides, by (low, high, triangle, corner): those of an edge next to each
// other.  Indices are ≥ 0.  Linear in the triangles, but for vertices of high
// valence.
std::vector<EdgeSide> SortedEdgeSides(const std::vector<Triangle>& triangles,
                                      FoldedTriangles folded);

// Calls visit(begin, end) for the sides of every edge.
template <typename Visit>
void ForEachEdge(const std::vector<EdgeSide>& sides, const Visit& visit) {
  const auto is_same = [](const EdgeSide& a, const EdgeSide& b) {
    return a.low == b.low && a.high == b.high;
  };
  const std::size_t count = sides.size();
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    end = begin + 1;
    while (end < count && is_same(sides[begin], sides[end])) ++end;
    visit(begin, end);
  }
}

bool UsesVertexTwice(const Triangle& t);

}  // namespace phongpd::internal
