// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/coarse_depth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/closest_on_triangle.h"

namespace phongpd::internal {

using Eigen::Vector3d;

double SurfaceDistance(const TriangleBvh& bvh, const Vector3d& x, int* near) {
  const auto squared = [&](int position) {
    const TriangleCorners& t = bvh.corners()[position];
    return ClosestOnTriangle(t[0], t[1], t[2], x).squared_distance;
  };
  double best = std::numeric_limits<double>::infinity();
  if (*near >= 0) best = squared(*near);
  bvh.tree().NearestFirst(
      best,
      [&](int node) { return bvh.tree().nodes()[node].SquaredDistance(x); },
      [&](int position) {
        const double found = squared(position);
        if (found < best) {
          best = found;
          *near = position;
        }
        return best;
      });
  return std::sqrt(best);
}

CoarseDepth::CoarseDepth(const TriangleBvh& bvh) {
  const BoxTree::Node& root = bvh.tree().nodes().front();
  min_ = root.min;
  max_ = root.max;
  spacing_ = (max_ - min_) / (kPoints - 1);
  depths_.resize(kPoints * kPoints * kPoints);
  tbb::parallel_for(0, kPoints, [&](int k) {
    int near = -1;
    for (int j = 0; j < kPoints; ++j) {
      for (int i = 0; i < kPoints; ++i) {
        const Vector3d x = min_ + spacing_.cwiseProduct(Vector3d(i, j, k));
        const double distance = SurfaceDistance(bvh, x, &near);
        depths_[Index(i, j, k)] =
            bvh.WindingNumber(x) > 0 ? distance : -distance;
      }
    }
  });
}

CoarseDepth::Bounds CoarseDepth::At(const Vector3d& x) const {
  // Depth changes by no more than the way to the nearest point of the grid;
  // outside the box it is the way to the box at the least.
  const Vector3d within = x.cwiseMax(min_).cwiseMin(max_);
  int at[3];
  Vector3d point = min_;
  for (int k = 0; k < 3; ++k) {
    const double steps = std::round((within[k] - min_[k]) / spacing_[k]);
    at[k] = std::clamp(static_cast<int>(steps), 0, kPoints - 1);
    point[k] += at[k] * spacing_[k];
  }
  const double depth = depths_[Index(at[0], at[1], at[2])];
  const double way = (x - point).norm();
  Bounds bounds = {depth - way, depth + way};
  const double outside = (x - within).norm();
  if (outside > 0.0) bounds.most = std::min(bounds.most, -outside);
  return bounds;
}

}  // namespace phongpd::internal
