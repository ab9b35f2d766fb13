// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/operands/grid_solid.h"
#include "core/solid/self_intersection.h"

namespace phongpd::internal {

// Moves vertices of `solid`, the rounded `original` with facets of the same
// indices but for those removed, to neighbouring grid points where facets cross
// that may not, so long as that leaves fewer crossings.  May not: facets of one
// vertex-connected component, and a cavity's with those of a shell around it
// that it did not cross before.  Returns the crossings that are left; only the
// first few of many.
std::vector<TrianglePair> MendCrossings(const TriangleMesh& original,
                                        GridSolid* solid);

}  // namespace phongpd::internal
