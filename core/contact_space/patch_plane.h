// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/exact_sign.h"

namespace phongpd::internal {

// The plane of a patch of triangles that lie in one plane up to rounding: the
// one through the two ends of the patch's longest extent (about) and the point
// farthest off their line.  Whatever the patch's shape, the others are then
// within a few times the rounding of these three of it.
class PatchPlane {
 public:
  // Three corners per triangle, at least one triangle.
  explicit PatchPlane(const std::vector<Eigen::Vector3d>& corners);

  // Mean of the triangles' normals, unit; zero when they have no area.
  const Eigen::Vector3d& normal() const { return normal_; }

  // Sign of the turn a → b → c seen from outside, along the coordinate axis
  // nearest to the normal; exact.
  int Turn(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
           const Eigen::Vector3d& c) const {
    return Orient2d(a[u_], a[v_], b[u_], b[v_], c[u_], c[v_]);
  }

  // A point of the plane rounded to double, and nearest to x up to rounding.
  Eigen::Vector3d Nearest(const Eigen::Vector3d& x) const;

 private:
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  int u_ = 0, v_ = 1;  // axes seen from outside
  Eigen::Vector3d origin_, e1_;
  Eigen::Vector3d e2_ = Eigen::Vector3d::Zero();
};

}  // namespace phongpd::internal
