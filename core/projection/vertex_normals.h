// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Facet and vertex normals of a closed, outward mesh.  Results do not depend,
// to the last bit, on the order of the triangles nor on which of a triangle's
// vertices comes first: contributions are summed in the order of their values.
namespace phongpd {

// Unit facet normals N_f, taken from the two shortest edges.  A triangle whose
// altitude on its longest edge is ≤ 1e-12 × the diagonal of the bounding box
// has no direction worth the name after rounding: its normal is zero, and it
// has no weight in anything that follows.
std::vector<Eigen::Vector3d> FacetNormals(const TriangleMesh& mesh);

// Unit vertex normals n₀ = Σ w_f N_f / |Σ w_f N_f| over the facets around each
// vertex; w_f is the facet's angle there, atan2(|a×b|, a·b), so that the way a
// flat patch is cut into triangles does not matter, as it does to the paper's
// plain average.  Zero where the sum vanishes (|Σ w_f N_f| ≤ 1e-12 Σ w_f) or no
// facet has a normal.
std::vector<Eigen::Vector3d> VertexNormals(
    const TriangleMesh& mesh,
    const std::vector<Eigen::Vector3d>& facet_normals);

// Area means Σ A_f N_f / Σ A_f around each vertex, of length ≤ 1 (NOT unit):
// the L² projection of the facet normals on the vertices, with lumped mass.
std::vector<Eigen::Vector3d> MeanNormals(
    const TriangleMesh& mesh,
    const std::vector<Eigen::Vector3d>& facet_normals);

// Solves (M + ℓ²L) n = M n₀ (implicit diffusion over the length ℓ on the
// surface): M lumped mass (⅓ of the incident areas), L the cotangent Laplacian
// of the intrinsic Delaunay triangulation of the surface, whose weights are
// ≥ 0.  So each n_i is a convex combination of the n₀ (discrete maximum
// principle), whatever slivers the mesh has; clamping the weights of the given
// triangulation instead would tie the ends of a sliver to each other at any
// distance.  The result is not normalised.  `ell` ≥ 0 in the mesh's unit.
//
// On a sphere of radius r the normal is a first harmonic: |n| = 1/(1 + 2ℓ²/r²)
// in the limit of a fine mesh.
//
// Deterministic for a given order of vertices and triangles.  Throws
// std::logic_error if the factorisation fails (M + ℓ²L is positive definite
// unless every triangle is degenerate).
std::vector<Eigen::Vector3d> DiffuseNormals(
    const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& n0,
    double ell);

}  // namespace phongpd
