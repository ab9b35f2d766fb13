// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// What a look at a mesh found.  All counts are exact.
struct MeshReport {
  std::size_t vertices = 0;  // used by a triangle
  std::size_t triangles = 0;
  int components = 0;                    // vertex-connected
  std::size_t non_finite_vertices = 0;   // NaN or infinite, used or not
  std::size_t bad_indices = 0;           // out of range
  std::size_t boundary_edges = 0;        // used by one triangle only
  std::size_t non_manifold_edges = 0;    // used by three or more
  std::size_t misoriented_edges = 0;     // used twice in the same direction
  std::size_t degenerate_triangles = 0;  // area exactly zero
  std::size_t duplicate_vertices = 0;    // same coordinates as an earlier one
  std::size_t duplicate_triangles = 0;   // same three vertices, any order
  std::size_t self_intersections = 0;    // pairs of triangles of ONE component
                                         // of which one enters the other
  std::size_t joined_vertices = 0;       // by MakeSolid
  int inverted_components = 0;           // shells turned by MakeSolid
  double volume = 0.0;                   // after turning, mesh unit cubed

  // One sentence per thing a user should know although it is no error.
  std::vector<std::string> warnings;
};

// The report's warnings, each with the mesh's name in it.
std::vector<std::string> NamedWarnings(const MeshReport& report,
                                       const std::string& name);

// Counts everything above without changing the mesh or throwing.
//  - Invalid indices: only vertices, triangles and the first two defects.
//  - Non-finite coordinates: no degenerate triangles, duplicate vertices,
//    self-intersections or volume.
//  - Edges of triangles that use a vertex twice do not count: such a triangle
//    is a folded edge and closes nothing.
//  - Non-manifold vertices, where parts touch in one point, are no defect.
//  - Self-intersections: exact.  A pair counts when one triangle has a point
//    in the inside of the other: piercing, a corner on a face, areas of one
//    plane that overlap.  A part may touch itself where edges meet edges.
//    Zero-area triangles intersect nothing.  Different components may overlap
//    or touch: their union is meant.
MeshReport ExamineMesh(const TriangleMesh& mesh);

}  // namespace phongpd
