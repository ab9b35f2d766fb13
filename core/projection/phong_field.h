// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The default ℓ everywhere: in C++, the program, scene files, Python and the
// viewer.  results/trade says why.
inline constexpr double kDefaultSmoothingLength = 0.2;

struct PhongFieldOptions {
  // ℓ as a share of D (ContactSpace::length); 0 is the paper's field.  Must be
  // in [0, 1].
  double smoothing_length = kDefaultSmoothingLength;
  // Longest edge of the field mesh as a share of D; longer edges are split at
  // mid-points (which leaves the surface as it is).  0: ℓ/2, or no bound for ℓ
  // = 0.  A diffusion that edges longer than ℓ do not resolve is a property of
  // the tessellation, not of the shape: against a mesh of edges ℓ/8 the field
  // is off by 3-25° (root mean square over box, U, wrench, cone/axes; ℓ =
  // 0.05-0.2) without splitting, by 1-3° with edges ≤ ℓ and by 0.2-1° with
  // edges ≤ ℓ/2; by up to 9° where parts are thinner than ℓ. Must be in [0, 1];
  // refused where it needs more than 4M triangles.
  double max_edge = 0.0;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;

  // ℓ = 0: the paper's field, but for the weight of facets: their angle at the
  // vertex, where the paper averages them plainly.
  static PhongFieldOptions Unsmoothed() {
    PhongFieldOptions options;
    options.smoothing_length = 0.0;
    return options;
  }
};

// Admissibility c: n_i · N_f ≥ c for every vertex i and incident facet f.
inline constexpr double kNormalLimiter = 0.1;

// Counts of what building a field met; all of them are published figures.
struct PhongFieldReport {
  std::size_t split_edges = 0;  // by length, inadmissibility or the 90° rule
  // Turned by the limiter: the smoothed normal towards n₀, or n₀ itself towards
  // the direction that maximises min_f n·N_f.  Where even that direction stays
  // below kNormalLimiter (needle tips) it is what the vertex gets.
  std::size_t limited_vertices = 0;
  // No direction has n·N_f > 0 for all facets (pinched or folded vertices).
  // Edges there are halved three times first, so n·N_f ≤ 0 happens only within
  // ⅛ of the vertex's original edges; elsewhere all guarantees hold.
  std::size_t inadmissible_vertices = 0;
  // Edges with n_i · n_j ≤ 1e-6 that splitting could not remove; 0 whenever
  // there is no inadmissible vertex.
  std::size_t obtuse_edges = 0;
  double min_normal_dot = 1.0;  // smallest n_i · N_f left
};

// A normal field that is continuous over C_cont: unit vertex normals n_i,
// interpolated as n(λ) = Σ λ_i n_i inside a triangle (engine of the closed
// form) or carried by tangent planes (tangent_plane_field.h, the paper).
//
// Everything is stored in the field's own frame: centred on the bounding box
// of the contact space and multiplied by `scale`, a power of two that brings
// the diagonal into [1, 2).  The frame change is exact in binary scaling, so
// scaling all input by 2^k gives the same bits.  Vertices and triangles come
// in canonical order (canonical_mesh.h), split ones after that in a fixed
// order: the field is independent, to the last bit, of the order of the input.
//
// Built in this order:
// 1. n₀ by averaging facets; where it leaves the admissible cone, turned into
//    it.  N_f is always the normal of the contact mesh's own triangle.
// 2. Inadmissible vertices confined, long edges split.  A mid-point's n₀ is the
//    mean of the two facets at its edge (on a flat patch, the facet normal).
// 3. ℓ > 0: (M + ℓ²L) n = M ⟨N⟩ with ⟨N⟩ the area means of the facet normals,
//    normalised, and turned back towards n₀ until admissible.
// 4. Edges with n_i·n_j ≤ 1e-6 split.  The mid-point's normal is the mean of
//    the two facets for ℓ = 0 and the mean of the ends' normals for ℓ > 0; both
//    are admissible because both ends are admissible for both facets.
// Frame change and each halving round coordinates by ≤ 2^-54: after m halvings
// the field mesh lies within (m + 1)·2^-53 of the contact mesh (field frame).
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

// Builds the field of a contact space.  Three sparse SPD solves for ℓ > 0, see
// vertex_normals.h. Throws InputError for bad options or an unusable mesh.
PhongField BuildPhongField(const ContactSpace& space,
                           const PhongFieldOptions& options = {});

}  // namespace phongpd
