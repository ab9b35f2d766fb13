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
  std::size_t non_finite_vertices = 0;   // NaN or infinite
  std::size_t bad_indices = 0;           // out of range
  std::size_t boundary_edges = 0;        // used by one triangle only
  std::size_t non_manifold_edges = 0;    // used by three or more, or twice in
                                         // the same direction
  std::size_t degenerate_triangles = 0;  // area exactly zero
  std::size_t duplicate_vertices = 0;    // same coordinates as an earlier one
  std::size_t duplicate_triangles = 0;   // same three vertices, any order
  std::size_t self_intersections = 0;    // pairs of triangles of ONE component
                                         // that meet outside shared features
  int inverted_components = 0;           // turned outward by MakeSolid
  double volume = 0.0;                   // after turning, mesh unit cubed

  // One sentence per thing a user should know although it is no error.
  std::vector<std::string> warnings;
};

// Counts everything above without changing the mesh or throwing.
// Self-intersections are counted only for finite meshes with valid indices;
// exact predicates.  Different components may overlap or touch: their union
// is meant.
MeshReport ExamineMesh(const TriangleMesh& mesh);

// Returns `mesh` as a solid that the contact-space builder accepts: finite,
// valid indices, closed, edge-manifold, at least one non-degenerate triangle,
// no self-intersection within a component, every component outward.  A
// component is outward when its volume is positive, or negative while it is
// enclosed by a positive one (a cavity).  Components facing the wrong way are
// turned, counted in report->inverted_components and said in its warnings.
// Vertices of exactly equal coordinates are NOT joined, except in triangle
// soups (STL), which ReadMesh already joins.
//
// Throws InputError, one line naming `name`, the first defect and its count.
// `report` may be null.
TriangleMesh MakeSolid(const TriangleMesh& mesh, const std::string& name,
                       MeshReport* report = nullptr);

}  // namespace phongpd
