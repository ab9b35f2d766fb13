// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// How facet normals are averaged into the vertex normal n₀.
enum class NormalWeight {
  kAngle,    // by the facet's angle at the vertex: independent of how coplanar
             // patches are triangulated (default)
  kUniform,  // plain average of adjacent facets: the paper's choice
};

struct PhongFieldOptions {
  // ℓ as a fraction of the contact space's bounding-box diagonal; 0 is the
  // paper's field.  Must be in [0, 1].
  double smoothing_length = 0.0;
  NormalWeight weight = NormalWeight::kAngle;
  // Admissibility n_i · N_f ≥ limiter for every vertex i and incident facet f.
  // Must be in (0, 1).
  double limiter = 0.1;
  // Longest edge of the field mesh as a fraction of the diagonal; longer edges
  // are split at mid-points (which leaves the surface as it is).  0: only what
  // the field needs, i.e. edges whose normals are ≥ 90° apart, and for ℓ > 0
  // edges longer than ℓ.
  double max_edge = 0.0;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// Counts of what building a field met; all of them are published figures.
struct PhongFieldReport {
  std::size_t split_edges = 0;       // by 90° rule, length or inadmissibility
  std::size_t limited_vertices = 0;  // pulled back towards n₀ by the limiter
  std::size_t inadmissible_vertices = 0;  // even n₀ violates n·N_f ≥ limiter
  std::size_t obtuse_edges = 0;  // still ≥ 90° apart when splitting gave up
  double min_normal_dot = 1.0;   // smallest n_i · N_f left
};

// A normal field that is continuous over C_cont: unit vertex normals n_i,
// interpolated as n(λ) = Σ λ_i n_i inside a triangle (engine of the closed
// form) or carried by tangent planes (tangent_plane_field.h, the paper).
//
// Everything is stored in the field's own frame: centred on the bounding box
// of the contact space and multiplied by `scale`, a power of two that brings
// the diagonal into [1, 2).  The frame change is exact in binary scaling, so
// scaling all input by 2^k gives the same bits.
struct PhongField {
  TriangleMesh mesh;                 // field frame, perhaps split
  std::vector<int> source_triangle;  // of the contact mesh, per triangle
  std::vector<std::array<int, 3>> neighbors;         // TriangleNeighbors(mesh)
  std::vector<Eigen::Vector3d> normals;              // unit, per vertex
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // user's unit
  double scale = 1.0;  // field length / user's length
  PhongFieldReport report;

  Eigen::Vector3d ToField(const Eigen::Vector3d& q) const {
    return (q - center) * scale;
  }
  Eigen::Vector3d FromField(const Eigen::Vector3d& x) const {
    return x / scale + center;
  }
};

// Builds the field on a closed, outward, edge-manifold mesh (a contact space).
// Three sparse SPD solves for ℓ > 0, see vertex_normals.h.
// Throws InputError for bad options or an unusable mesh.
PhongField BuildPhongField(const TriangleMesh& contact_mesh,
                           const PhongFieldOptions& options = {});

}  // namespace phongpd
