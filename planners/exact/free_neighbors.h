// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// TriangleNeighbors(mesh), but where more than two triangles meet in one
// segment each gets the one across the free space in front of it, by exact
// predicates.
//
// There the solid touches itself.  Meshes pair such triangles as they like, by
// other copies of the vertices; paired around the solid, two free regions that
// touch would count as one, though nothing passes between them: C_obj is
// closed.
std::vector<std::array<int, 3>> FreeNeighbors(const TriangleMesh& mesh);

}  // namespace phongpd
