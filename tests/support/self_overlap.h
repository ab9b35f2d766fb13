// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/mesh/triangle_mesh.h"

// How badly a surface runs through itself, as a length: it tells a crossing
// that rounding the vertices made from one that is really there.
namespace phongpd {

// How far two triangles have to be moved apart to share no more than their
// boundaries: least overlap over the directions that can separate them, in
// the mesh's unit.  ≤ 0 when one of them does.  Triangles of one plane have 0.
double OverlapDepth(const std::array<Eigen::Vector3d, 3>& a,
                    const std::array<Eigen::Vector3d, 3>& b);

// The largest overlap of two triangles of the mesh; 0 when none overlap.
double DeepestSelfOverlap(const TriangleMesh& mesh);

}  // namespace phongpd
