// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

namespace phongpd {

// Exact: do the closed segment a b and the triangle t share a point?  In any
// position: in one plane, through an edge or a vertex, a = b.  A triangle
// without area meets nothing.  If so, *fraction is the first common point's
// share of the way from a to b, in [0, 1], rounded; otherwise it means nothing.
// Finite points.  Does not allocate (but for coordinates beyond 1e±70,
// exact_sign.h).
bool MeetsTriangle(const std::array<Eigen::Vector3d, 3>& t,
                   const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                   double* fraction);

}  // namespace phongpd
