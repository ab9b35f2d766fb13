// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Exact intersection tests between the triangles of a mesh.  Two triangles
// meet properly when one of them has a point in the inside of the other, its
// edges not included.  So neighbours do not meet properly unless they are
// folded onto each other, and surfaces may touch where edges meet edges, also
// along a part of an edge, as next to a zero-area triangle.  Zero-area
// triangles meet nothing.  All functions require finite coordinates and valid
// indices.
namespace phongpd::internal {

// Corners with identical coordinates or on one line.
bool IsDegenerate(const TriangleMesh& mesh, const Triangle& triangle);

// Whether two triangles of the mesh, both with an area, meet properly.
bool MeetProperly(const TriangleMesh& mesh, std::size_t s, std::size_t t);

// Pairs of triangles with equal labels that meet properly: how many.  The
// first `limit` of them, by their numbers, the lower one first, are appended to
// *pairs, which may be null where that is 0.
using TrianglePair = std::pair<std::size_t, std::size_t>;
std::size_t CountSelfIntersections(const TriangleMesh& mesh,
                                   const std::vector<int>& labels,
                                   std::size_t limit = 0,
                                   std::vector<TrianglePair>* pairs = nullptr);

// Whether a triangle of `a` meets one of `b` properly.
bool Intersect(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace phongpd::internal
