// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// v of length 1, of any size but zero: that stays.  (Eigen's own divides zero
// by zero on the way.)
inline Eigen::Vector3d Unit(const Eigen::Vector3d& v) {
  return v.isZero(0.0) ? v : v.stableNormalized();
}

// (v₁ − v₀) × (v₂ − v₀) of a triangle of the mesh, of length 1: outward on a
// solid.  Zero if the triangle has no area.
inline Eigen::Vector3d UnitNormal(const TriangleMesh& mesh,
                                  const Triangle& triangle) {
  const Eigen::Vector3d& v_0 = mesh.vertices[triangle[0]];
  return Unit((mesh.vertices[triangle[1]] - v_0)
                  .cross(mesh.vertices[triangle[2]] - v_0));
}

}  // namespace phongpd
