// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// The positions, in order, of the triangles that are not the same set of points
// as one before: whose corners have the same coordinates in whatever order.
// Many files store each face twice, once for either side; one of them meets
// whatever both do, and is a quarter of the work against another such file.
// Finite corners.
std::vector<std::size_t> DistinctTriangles(
    const std::vector<TriangleCorners>& corners);

}  // namespace phongpd::internal
