// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact/build_stages.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/surface_piece.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/minkowski/windows/window_plan.h"

// C_cont in boxes of q-space, each arranged for itself, joined to the surface
// that one arrangement gives: memory is that of the boxes in flight and of the
// surface.
namespace phongpd::internal {

// Facets of the convolution in a box, at the most where that can be had.
inline constexpr std::size_t kFacetsOfBox = 4096;

// C_cont in each of the boxes; one box at a time for each thread.  Throws
// BuildRefusal when `limits` are passed.
std::vector<SurfacePiece> ArrangeBoxes(const std::vector<PlannedWindow>& boxes,
                                       const Convolution& convolution,
                                       const SolidCollision& judge,
                                       const BuildLimits& limits);

// Joins boxes that fill all of space in which C_cont is, and writes the
// surface: mesh, planes and kinds are those of one arrangement, to the last
// bit.  The report is to be finished.  Throws LeakError where a cell beside the
// border of a box is so thin that no point of it can be judged.
void WriteJoinedSurface(const std::vector<SurfacePiece>& boxes, bool outer_only,
                        const GridFrame& frame, const BuildLimits* limits,
                        StageClock* clock, ContactSpace::Parts* out);

}  // namespace phongpd::internal
