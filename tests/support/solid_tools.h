// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>

#include "core/mesh/triangle_mesh.h"

// Independent routes to facts that tests compare the engine with.
namespace phongpd::testing {

// Generalised winding number ¹⁄₄π Σ solid angles of the triangles seen from q
// (van Oosterom & Strackee 1983), summed in long double: 1 inside, 0 outside,
// meaningless only within rounding of the surface.
double WindingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& q);

// Surface of a random set of unit cells in an n × n × n block, in random
// integer position: the worst case of coplanarity.  No two cells meet in an
// edge only, so the surface is edge-manifold; it may have several components,
// tunnels and cavities.  At least one cell is filled.
TriangleMesh RandomVoxelSolid(int n, double fill, std::mt19937_64* random);

// Uniform in the box, widened by a tenth on every side.
Eigen::Vector3d RandomPoint(const BoundingBox& box, std::mt19937_64* random);

// A uniform rotation.
Eigen::Matrix3d RandomRotation(std::mt19937_64* random);

// Uniform on a random triangle (not area-weighted: small ones count too).
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  // of the facet, unit
};
SurfacePoint RandomSurfacePoint(const TriangleMesh& mesh,
                                std::mt19937_64* random);

}  // namespace phongpd::testing
