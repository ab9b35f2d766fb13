// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Collapses edges whose ends have equal coordinates, as distinct exact points
// may have after rounding: the two triangles at such an edge have no area, so
// the surface stays the same point set.  Left alone are edges whose collapse
// would pinch the surface or flatten a tetrahedron (the ends have another
// common neighbour than the two opposite corners): a closed, edge-manifold
// mesh of one fan a vertex stays one, of the same genus.
//
// Returns the former index of every triangle that remains; vertices without a
// triangle are removed, the order of both is kept.
std::vector<int> CollapseZeroEdges(TriangleMesh* mesh);

}  // namespace phongpd::internal
