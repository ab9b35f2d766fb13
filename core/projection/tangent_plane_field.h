// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/projection/phong_field.h"

namespace phongpd {

// The paper's continuous field of tangent planes over the triangles of a
// PhongField (paper, Eqs. 4-11; Panozzo, Baran, Diamanti, Sorkine-Hornung,
// "Weighted Averages on Surfaces", SIGGRAPH 2013).  The field refers to the
// PhongField by index only: pass the same one to every function below.
//
//   T_i   2×3, orthonormal rows, ⟂ n_i                          per vertex
//   R_ij  = Ort(T_j T_iᵀ), 2×2: R_ij T_i is the basis at i that is closest to
//         T_j (polar decomposition; R_ji = R_ijᵀ)               per edge
//   Ψ_ij(λ) = λ_i R_ij T_i + λ_j T_j                            on the edge
//   Ψ(λ) = Σ_(ij) w_ij(λ) E_ij Ψ_ij(λ),  (ij) = (12), (23), (31),
//         w_ij = λ_i λ_j / (λ_1 λ_2 + λ_2 λ_3 + λ_3 λ_1)
//   E_ij  ∈ O(2), aligns the three edge frames with each other, so that at
//         each vertex the two frames that meet there agree as well as they
//         can (Eq. 11, alternating Procrustes)                  per triangle
//
// Only the plane (row space of Ψ) has a meaning; its entries depend on bases.
// Inside a triangle Ψ_ij is extended by the projection of λ on the edge,
// λ_i/(λ_i+λ_j); see the .cc for the polynomial form actually evaluated.
struct TangentPlaneField {
  using Basis = Eigen::Matrix<double, 2, 3>;

  // Frames of one triangle with everything multiplied out: edge[k][0] and
  // edge[k][1] are the two bases that edge k = (v_k, v_{k+1 mod 3}) has at
  // its start and its end, E_k already applied.
  struct Frames {
    std::array<std::array<Basis, 2>, 3> edge;
  };

  std::vector<Basis> bases;    // T_i, per vertex
  std::vector<Frames> frames;  // per triangle
};

// Never fails on an admissible PhongField.  Where normals across an edge are
// ≥ 90° apart (PhongFieldReport::obtuse_edges) the plane turns the short way
// and its normal changes sign somewhere inside the two triangles.
TangentPlaneField BuildTangentPlaneField(const PhongField& field);

// Unit normal of the plane at λ (Σλ = 1, λ ≥ 0): ± the cross product of the
// rows of Ψ(λ), with the sign of its product with Σ λ_i n_i.  At a vertex it
// is n_i; on an edge it depends on that edge's two vertices only.
Eigen::Vector3d TangentPlaneNormal(const PhongField& field,
                                   const TangentPlaneField& planes,
                                   int triangle,
                                   const Eigen::Vector3d& lambda) noexcept;

// A Phong projection of x on one triangle.  Field frame.
struct TangentPlaneHit {
  Eigen::Vector3d lambda;    // ≥ −1e-9, sums to 1
  double s = 0.0;            // x = p(λ) + s·normal, < 0 inside
  Eigen::Vector3d normal;    // unit, outward
  Eigen::Vector3d gradient;  // exact ∇s, implicit differentiation; zero where
                             // the Newton system is singular (a fold)
};

// Solves Ψ(λ)(Σ λ_i q_i − x) = 0, Σ λ_i = 1 (paper, Eqs. 7, 8) by Newton from
// `start_lambda`; the paper starts from (⅓, ⅓, ⅓).  True when it converged to
// λ ≥ −1e-9 in every coordinate; false, with *hit untouched, otherwise: the
// triangle may still hold a projection that another start finds.  Field
// frame, no allocation, thread-safe.
bool ProjectOnTangentPlanes(const PhongField& field,
                            const TangentPlaneField& planes, int triangle,
                            const Eigen::Vector3d& x,
                            const Eigen::Vector3d& start_lambda,
                            TangentPlaneHit* hit) noexcept;

}  // namespace phongpd
