// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/operands/grid_solid.h"

// Rounding to the grid moves vertices by half a step a coordinate.  Where a
// solid's parts are closer than that, the rounded surface may cross itself,
// turn a shell inside out or flatten a wall: then it bounds no solid, and the
// contact space built on it would leak or lack the wall.
namespace phongpd::internal {

// What was rounded.
struct RoundedOperand {
  const RoundedFrom& from;
  bool reflect = false;  // rounded −mesh, with its facets turned
  const std::string& name;
};

// Makes vertices and facets of `solid` bound a solid again.  They are the
// operand's, of the same indices, but for the facets that `lost` lists with the
// vertices they had on the grid.
//  - Components that were flattened or turned inside out are removed, and so
//    are facets that lie back to back on the same three vertices.
//  - Where facets of one component cross, or a cavity's with the shell around
//    it, vertices move to neighbouring grid points, a step in each coordinate,
//    so long as that leaves fewer crossings.
// Throws InputError naming the operand, the defect and a place of it when
// facets still cross, or what was removed, `lost` included, is not inside the
// solid that is left nor within four times the rounding of it.
void MendRounding(const RoundedOperand& operand, std::vector<Triangle> lost,
                  GridSolid* solid);

}  // namespace phongpd::internal
