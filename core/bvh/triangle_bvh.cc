// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/triangle_bvh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace phongpd {
namespace {

using Eigen::Vector3d;

std::atomic<long> built_trees{0};

}  // namespace

TriangleBvh::TriangleBvh(const TriangleMesh& mesh) : corners_(CornersOf(mesh)) {
  for (const TriangleCorners& t : corners_) {
    for (const Vector3d& v : t) {
      largest_ = std::max(largest_, v.cwiseAbs().maxCoeff());
    }
  }
  tree_ = SortIntoTree(&corners_);
  const BoundingBox bounds = ComputeBounds(mesh);
  center_ = bounds.Center();
  const double diagonal = bounds.Diagonal();
  if (diagonal > 0.0) scale_ = std::ldexp(1.0, -std::ilogb(diagonal));
  ++built_trees;
}

long TriangleBvh::CountBuilt() { return built_trees; }

TriangleBvh::Closest TriangleBvh::FindClosest(
    const Vector3d& q) const noexcept {
  // Squares of coordinates beyond 1e100 diagonals would overflow; from there
  // the direction decides, and pulling q closer leaves it as it is.
  Vector3d x = (0.5 * q - 0.5 * center_) * scale_;
  const double far = x.cwiseAbs().maxCoeff();
  const double shrink = far > 1e100 ? 1e100 / far : 1.0;
  if (!std::isfinite(far)) {
    x = (q / q.cwiseAbs().maxCoeff()) * 1e100;
  } else {
    x *= 2.0 * shrink;
  }
  int best = -1;
  TrianglePoint nearest;
  nearest.squared_distance = std::numeric_limits<double>::infinity();
  tree_.NearestFirst(
      nearest.squared_distance,
      [&](int index) {
        return ToFrame(tree_.nodes()[index]).SquaredDistance(x);
      },
      [&](int position) {
        const TriangleCorners t = ToFrame(corners_[position]);
        const TrianglePoint p = ClosestOnTriangle(t[0], t[1], t[2], x);
        if (p.squared_distance < nearest.squared_distance) {
          nearest = p;
          best = position;
        }
        return nearest.squared_distance;
      });
  Closest result;
  if (best < 0) return result;
  result.triangle = tree_.order()[best];
  result.lambda = nearest.lambda;
  result.distance = std::sqrt(nearest.squared_distance) / scale_;
  if (shrink != 1.0 || !std::isfinite(far)) {
    result.distance = std::min((q - center_).stableNorm(),
                               std::numeric_limits<double>::max());
  }
  return result;
}

}  // namespace phongpd
