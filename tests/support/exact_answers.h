// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/penetration_metric.h"

// What queries must answer, by other routes, and what every answer has.
namespace phongpd::testing {

// Where q lies relative to a closed mesh, in rational numbers throughout: on a
// triangle, or the parity of the triangles a ray crosses, in the first of some
// fixed directions that meets no edge.  Slow; any finite q, denormals too.
Location RationalLocation(const TriangleMesh& mesh, const Eigen::Vector3d& q);

// −1 inside, 0 on the surface, +1 outside.
int SignOf(Location location);

// Of the signed distance; 99 where `inside` says something else.
int SignOf(const PenetrationResult& result);

// Distance from q to the surface: the least over all triangles, by CGAL in
// long double.
double TrueDistance(const TriangleMesh& mesh, const Eigen::Vector3d& q);

// An answer without NaN or Inf, with a status, and with a unit direction.
bool IsWhole(const PenetrationResult& result);

}  // namespace phongpd::testing
