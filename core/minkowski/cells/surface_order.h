// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/minkowski/cells/surface_assembly.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// Numbers vertices and patches by what they are, so that a surface comes out
// the same to the last bit whatever arrangement, in whatever order, it was
// taken from: points by their nearest doubles (and exactly where these agree),
// loops from their least point on, patches by their least loop, vertices by
// their first place in them.  Vertices that no loop uses are dropped.  Fills in
// ranks and positions.
void OrderSurface(const ExactPoints& points, int units_per_step,
                  PatchSurface* surface);

}  // namespace phongpd::internal
