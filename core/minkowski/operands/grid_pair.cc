// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/grid_pair.h"

namespace phongpd::internal {

GridPair MakeGridPair(const TriangleMesh& robot, const std::string& robot_name,
                      const TriangleMesh& obstacle,
                      const std::string& obstacle_name,
                      LatticeDivisor divisor) {
  GridPair pair;
  pair.frame = PlaceOnGrid(robot, obstacle, divisor);
  const GridFrame& frame = pair.frame;
  const RoundedFrom of_obstacle = {obstacle, frame.step, frame.rounding};
  const RoundedFrom of_robot = {robot, frame.step, frame.rounding};
  pair.obstacle =
      MakeGridSolid(frame.obstacle, obstacle.triangles, false, obstacle_name,
                    pair.IsRounded() ? &of_obstacle : nullptr);
  pair.reflected_robot =
      MakeGridSolid(frame.robot, robot.triangles, true, robot_name,
                    pair.IsRounded() ? &of_robot : nullptr);
  return pair;
}

}  // namespace phongpd::internal
