// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/oracle/collision_oracle.h"

namespace phongpd::testing {

// FCL's word on two meshes, once they are checked.
inline CollisionOracle FclOracleOf(const TriangleMesh& robot,
                                   const TriangleMesh& obstacle) {
  return CollisionOracle(MakeSolid(robot, "robot"),
                         MakeSolid(obstacle, "obstacle"));
}

}  // namespace phongpd::testing
