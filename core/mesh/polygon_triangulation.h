// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Triangulates a planar polygon without adding points.  The first loop is the
// outline, counter-clockwise; the others are holes, clockwise; indices count
// the points through all loops.  Constrained Delaunay triangulation with
// exact predicates: n + 2·holes − 2 counter-clockwise triangles, in an order
// that depends on the points only.
//
// Returns no triangle when the loops are not simple: a point occurs twice or
// edges cross.  Requires finite coordinates.
std::vector<Triangle> TriangulatePolygon(
    const std::vector<std::vector<Eigen::Vector2d>>& loops);

// The same for one loop in space, through its projection along the axis
// closest to its (Newell) normal.  The fan around the first corner is used
// if it is right, and also if nothing is: warped or crossing polygons.
std::vector<Triangle> TriangulatePolygon(
    const std::vector<Eigen::Vector3d>& corners);

}  // namespace phongpd::internal
