// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Where the planes x = const, y = const, z = const of a grid stand; ascending,
// two or more on every axis.
using GridCuts = std::array<std::vector<double>, 3>;

// The union of the cells of a grid for which `is_solid(i, j, k)`; two
// triangles per exposed cell face, corners shared.
TriangleMesh UniteCells(const GridCuts& cuts,
                        const std::function<bool(int, int, int)>& is_solid);

// The same surface with every flat face triangulated as one polygon: no
// vertex inside a face or inside a straight edge.  Requires a result of
// UniteCells; it comes back as it is where it is not edge-manifold or the
// border of a face meets itself.
TriangleMesh WithWholeFaces(const TriangleMesh& cells);

}  // namespace phongpd::internal
