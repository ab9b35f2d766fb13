// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace phongpd {

// The point Σ λ_i q_i of a triangle closest to some x.
struct TrianglePoint {
  Eigen::Vector3d lambda = Eigen::Vector3d::Zero();  // ≥ 0, sums to 1
  double squared_distance = 0.0;
};

// Closest point of the triangle a, b, c, slivers and degenerate triangles
// included: the foot of the perpendicular where it falls into the triangle,
// and the three edges, compared by the distance actually reached.
TrianglePoint ClosestOnTriangle(const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b,
                                const Eigen::Vector3d& c,
                                const Eigen::Vector3d& x) noexcept;

}  // namespace phongpd
