// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Exact intersection tests between the triangles of a mesh.  Two triangles
// meet properly when they share a point that is on no corner and no edge they
// have in common; corners are the same when their coordinates are, so surface
// parts may touch along whole vertices and edges.  Zero-area triangles meet
// nothing.  All functions require finite coordinates and valid indices.
namespace phongpd::internal {

// Corners with identical coordinates or on one line.
bool IsDegenerate(const TriangleMesh& mesh, const Triangle& triangle);

// Pairs of triangles with equal labels that meet properly.
std::size_t CountSelfIntersections(const TriangleMesh& mesh,
                                   const std::vector<int>& labels);

// Whether a triangle of `a` meets one of `b` properly.
bool Intersect(const TriangleMesh& a, const TriangleMesh& b);

}  // namespace phongpd::internal
