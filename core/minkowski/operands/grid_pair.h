// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/operands/grid_frame.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// Both operands on their common grid: B, and −A as the convolution takes it.
struct GridPair {
  GridFrame frame;
  GridSolid obstacle, reflected_robot;

  bool IsRounded() const { return frame.rounding > 0.0; }
};

// Two solids (PrepareOperand); kPowerOfTwo where configurations are asked for.
// Throws InputError naming the operand of which
// no solid is left on the grid.
GridPair MakeGridPair(const TriangleMesh& robot, const std::string& robot_name,
                      const TriangleMesh& obstacle,
                      const std::string& obstacle_name,
                      LatticeDivisor divisor = LatticeDivisor::kGreatest);

}  // namespace phongpd::internal
