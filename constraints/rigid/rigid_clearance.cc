// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_clearance.h"

#include <cmath>

#include "constraints/rigid/clearance_search.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/numbers.h"
#include "core/number_text.h"

namespace phongpd {
namespace internal {

// The scale is a power of two, which is exact but for the smallest numbers.
RigidClearance InUsersUnit(const RigidSides& sides,
                           const FramedClearance& found) {
  RigidClearance clearance;
  const double scale = sides.frame.scale;
  if (found.lower > 0.0) {
    clearance.lower = std::nextafter(found.lower / scale, 0.0);
  }
  if (found.upper > 0.0) {
    clearance.upper = std::nextafter(found.upper / scale, kInfinity);
  }
  clearance.time = found.time;
  clearance.is_resolved = found.is_resolved;
  clearance.tests = found.tests;
  if (found.robot >= 0) {
    NameTriangles(sides, found.robot, found.obstacle, &clearance);
  }
  return clearance;
}

void RequireTolerance(const ClearanceTolerance& tolerance) {
  if (!(tolerance.relative >= 0.0 && tolerance.relative < 1.0)) {
    throw InputError(
        "clearance tolerance: relative: expected a share in [0, 1), found " +
        Rounded(tolerance.relative));
  }
  if (!(tolerance.absolute >= 0.0 && std::isfinite(tolerance.absolute))) {
    throw InputError(
        "clearance tolerance: absolute: expected a length of at least 0, "
        "found " +
        Rounded(tolerance.absolute));
  }
}

}  // namespace internal

RigidClearance MotionClearance(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const RigidMotion& motion,
                               const ClearanceTolerance& tolerance) {
  return RigidJudge(robot, obstacle).Clearance(motion, tolerance);
}

}  // namespace phongpd
