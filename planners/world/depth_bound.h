// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/motion_oracle.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A way out of an obstacle: A + q + length · direction and B share no inner
// point.
struct WayOut {
  double length = 0.0;  // user's unit, rounded
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

// An upper bound of the penetration depth
//
//     min { |t| : A + q + t and B share no inner point }
//
// of a robot A at q in an obstacle B, without their contact space: the length
// of a translation that is proved to separate them.  The least of
//  - along each of some hundred directions d (the neighbours on a lattice, and
//    facet normals of both), what parts the convex hulls:
//    max_{b ∈ B} d·b − min_{a ∈ A} d·a − d·q;
//  - along some of them, shorter ways that the exact oracle finds free.
// It is the depth itself where both are convex and leave by a facet; it may be
// far above it in deep hollows.  0: the hulls only touch.  Time is linear in
// the vertices, but for some 200 tests by the oracle, which must be of A and
// B, both not empty and finite.
WayOut BoundDepth(const TriangleMesh& robot, const TriangleMesh& obstacle,
                  const Eigen::Vector3d& q, const MotionOracle& oracle);

}  // namespace phongpd
