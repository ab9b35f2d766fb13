// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/cells/surface_assembly.h"
#include "core/minkowski/cells/surface_piece.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// C_cont whole, with what its patches refer to; half grid steps.
struct JoinedSurface {
  Convolution sides;  // a facet for each oriented plane, without corners
  PlaneGroups groups;
  ExactPoints points;
  PatchSurface surface;
  int cavities = 0;
};

// Joins the pieces of windows that fill all of space in which C_cont is.  Equal
// points become one, edges in walls are split where neighbours' ones end, and
// what the walls have cut is one patch again: the surface is the one that an
// arrangement without walls gives, also in its order.  Throws std::logic_error
// where the pieces do not fit: they are of one build, or should be.
//
// `options` with merge_coplanar and 2 units per step.
JoinedSurface JoinPieces(const std::vector<SurfacePiece>& pieces,
                         const AssemblyOptions& options);

}  // namespace phongpd::internal
