// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/motion_oracle.h"

namespace phongpd::testing {

// The oracle of two meshes, once they are checked: ours, or CollisionOracle.
template <typename Oracle = MotionOracle>
Oracle OracleOf(const TriangleMesh& robot, const TriangleMesh& obstacle) {
  return Oracle(MakeSolid(robot, "robot"), MakeSolid(obstacle, "obstacle"));
}

}  // namespace phongpd::testing
