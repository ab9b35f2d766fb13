// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Where a mesh is no solid: what MakeSolid counts, at its places.
namespace phongpd {

enum class DefectKind {
  kOpenEdge,          // an edge of one triangle
  kNonManifoldEdge,   // of three or more
  kMisorientedEdge,   // of two that run through it in the same direction
  kSelfIntersection,  // two triangles of one part that enter each other
};

// "open edge", "edge of three or more triangles", "edge of two triangles of
// one direction", "self-intersection".
const char* ToString(DefectKind kind);

struct MeshDefect {
  DefectKind kind = DefectKind::kOpenEdge;
  // The middle of the edge; of an intersection a point that the two triangles
  // have in common, to rounding.  The mesh's own unit.
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  std::vector<int> triangles;  // that meet there, of the given mesh
};

// The defects, edges first, each kind in the order of the triangles; the first
// `limit` of each kind.  As in MakeSolid, vertices of equal coordinates count
// as one where that leaves fewer bad edges, and triangles that use a vertex
// twice have no edges.  Of a mesh with bad edges MakeSolid counts no
// intersections; here they come, too.  None for bad indices or coordinates that
// are not finite.
std::vector<MeshDefect> FindDefects(
    const TriangleMesh& mesh,
    std::size_t limit = std::numeric_limits<std::size_t>::max());

// Those of edges alone, which takes no search.
std::vector<MeshDefect> FindEdgeDefects(
    const TriangleMesh& mesh,
    std::size_t limit = std::numeric_limits<std::size_t>::max());

// The genus of the surface: handles of all its parts together, each boundary
// loop closed by a disc; -1 where an edge has more than two triangles or a
// boundary branches.  By Euler's formula V − E + F = 2 (parts − genus).
int SurfaceGenus(const TriangleMesh& mesh);

}  // namespace phongpd
