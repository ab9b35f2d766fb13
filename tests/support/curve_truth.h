// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/trajectory.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::testing {

enum class CurveTruth {
  kMeets,   // shares a point with a triangle
  kMisses,  // with none
  kGrazes,  // not told apart after 100 halvings: touches, or as good as that
};

// Does the curve meet the surface?  By rationals, without any rounding: of each
// triangle, the heights of the Bézier points above its plane and beyond its
// edges, halved until their signs tell.
CurveTruth MeetsSurface(const CurvePiece& piece, const TriangleMesh& mesh);

}  // namespace phongpd::testing
