// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Convex hull of the vertices that triangles use, exact, outward, vertices
// kept bit for bit.  They must not lie in one plane.
TriangleMesh HullOfVertices(const TriangleMesh& mesh);

}  // namespace phongpd::internal
