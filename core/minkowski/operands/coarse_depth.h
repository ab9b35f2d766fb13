// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/triangle_bvh.h"

namespace phongpd::internal {

// Distance of x from the surface, user's coordinates of the tree; the search
// begins at the triangle at position *near, if that is ≥ 0, and leaves the
// closest one there.
double SurfaceDistance(const TriangleBvh& bvh, const Eigen::Vector3d& x,
                       int* near);

// Bounds of how deep points are in a solid, below the nearest surface (< 0:
// outside, by winding numbers), from a grid of 24³ points: where that decides
// no triangle is looked at.
class CoarseDepth {
 public:
  // At least one triangle.
  explicit CoarseDepth(const TriangleBvh& bvh);

  struct Bounds {
    double least, most;
  };
  Bounds At(const Eigen::Vector3d& x) const;

 private:
  static constexpr int kPoints = 24;  // along each axis
  static int Index(int i, int j, int k) {
    return (k * kPoints + j) * kPoints + i;
  }

  Eigen::Vector3d min_, max_, spacing_;
  std::vector<double> depths_;
};

}  // namespace phongpd::internal
