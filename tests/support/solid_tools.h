// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>

#include "core/mesh/triangle_mesh.h"
#include "problems/shapes/random_solids.h"

// Independent routes to facts that tests compare the engine with.
namespace phongpd::testing {

// Generalised winding number ¹⁄₄π Σ solid angles of the triangles seen from q
// (van Oosterom & Strackee 1983), summed in long double: 1 inside, 0 outside,
// meaningless only within rounding of the surface.
double WindingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& q);

// Of that side, around a point.
TriangleMesh Cube(double side,
                  const Eigen::Vector3d& center = Eigen::Vector3d::Zero());

// [0, 1]³.
TriangleMesh UnitBox();

// Area of a regular polygon by its circumradius.
double PolygonArea(int sides, double radius = 1.0);

// VoxelSurface of RandomVoxels without edge contact: the worst case of
// coplanarity.
TriangleMesh RandomVoxelSolid(int n, double fill, std::mt19937_64* random);

// The generators, under the names tests know them by.
using phongpd::RandomPoint;
using phongpd::RandomRotation;
using phongpd::RandomSurfacePoint;

}  // namespace phongpd::testing
