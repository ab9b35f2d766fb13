// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/near_triangles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace phongpd {
namespace {

using Eigen::Vector3d;

// More than these take longer than the tree.
constexpr std::size_t kMost = 256;
constexpr std::size_t kFew = 48;
constexpr double kMostSteps = 16.0, kFewestSteps = 1.0;
// Rounding of distances, frame of SurfaceWalk.
constexpr double kFootRounding = 1e-14;
constexpr double kPlaneRounding = 1e-11;
// sin² of a triangle's angle between its two edges, below which its plane is
// not used.
constexpr double kFlatTriangle = 1e-4;

void SetPlane(const TriangleCorners& t, Vector3d* normal, double* offset) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0];
  const Vector3d n = u.cross(v);
  const double squared = n.squaredNorm();
  if (!(squared > kFlatTriangle * u.squaredNorm() * v.squaredNorm())) return;
  *normal = n / std::sqrt(squared);
  *offset = normal->dot(t[0]);
}

}  // namespace

SurfaceFoot NearTriangles::FindClosest(const SurfaceWalk& walk,
                                       const Vector3d& x,
                                       const SurfaceFoot& seed, double step) {
  SurfaceFoot best = seed;
  double distance = std::sqrt(best.squared_distance);
  const double gone = (x - anchor_).norm();
  if (distance + gone + kFootRounding <= radius_) {
    for (const Near& near : near_) {
      if (near.far - gone - kFootRounding >= distance) continue;
      // No point of the triangle is closer than its plane.
      const double above = std::abs(near.normal.dot(x) - near.offset);
      if (above > distance + kPlaneRounding) continue;
      const SurfaceFoot foot = walk.FootOn(near.triangle, x);
      if (foot.squared_distance >= best.squared_distance) continue;
      best = foot;
      distance = std::sqrt(best.squared_distance);
    }
    return best;
  }
  best = walk.FindClosest(x, seed);
  List(walk, x, std::sqrt(best.squared_distance) + 2.0 * ahead_ * step);
  return best;
}

void NearTriangles::List(const SurfaceWalk& walk, const Vector3d& x,
                         double radius) {
  near_.clear();
  near_.reserve(kMost);
  anchor_ = x;
  radius_ = radius;
  const BoxTree& tree = walk.bvh().tree();
  tree.ForEach(
      [&](int index) {
        return walk.bvh().ToFrame(tree.nodes()[index]).SquaredDistance(x) <=
               radius * radius;
      },
      [&](int position) {
        const int triangle = tree.order()[position];
        const double far = std::sqrt(walk.FootOn(triangle, x).squared_distance);
        if (far > radius) return true;
        if (near_.size() == kMost) {
          radius_ = -1.0;
          return false;
        }
        near_.push_back({far, 0.0, triangle, Vector3d::Zero()});
        SetPlane(walk.corners(triangle), &near_.back().normal,
                 &near_.back().offset);
        return true;
      });
  if (radius_ < 0.0) {
    ahead_ = std::max(kFewestSteps, 0.5 * ahead_);
  } else if (near_.size() < kFew) {
    ahead_ = std::min(kMostSteps, 2.0 * ahead_);
  }
}

}  // namespace phongpd
