// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/feature_search.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/unit_normal.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

constexpr double kOnSurface = 1e-12;
// Farther away than this many diagonals squares lose their meaning, and no
// two points of the surface are a millionth of a degree apart.
constexpr double kFar = 1e8;

// False for NaN, without an invalid operation.
bool IsNear(const Vector3d& x) {
  return std::islessequal(std::abs(x[0]), kFar) &&
         std::islessequal(std::abs(x[1]), kFar) &&
         std::islessequal(std::abs(x[2]), kFar);
}

}  // namespace

FeatureSearch::FeatureSearch(ContactSpace space)
    : space_(std::move(space)), bvh_(&space_.bvh()) {
  for (const BoxTree::Node& node : bvh_->tree().nodes()) {
    const BoxTree::Node box = bvh_->ToFrame(node);
    radius_.push_back(0.5 * (box.max - box.min).norm());
  }
}

bool FeatureSearch::IsShadowed(int index, const Vector3d& x,
                               const Vector3d* taken, int count,
                               double cos_limit) const noexcept {
  const BoxTree::Node node = bvh_->ToFrame(bvh_->tree().nodes()[index]);
  const Vector3d to_x = x - 0.5 * (node.min + node.max);
  const double radius = radius_[index];
  // From x the ball around the box, D away, fills the half angle β,
  // sin β = r/D.  It stays in the cone of half angle L about t if its centre
  // is within L − β of t:  to_x·t ≥ D cos(L − β) = cos L √(D² − r²) + sin L r.
  const double squared = to_x.squaredNorm() - radius * radius;
  const double sin_limit = std::sqrt(1.0 - cos_limit * cos_limit);
  if (!(squared > 0.0) ||
      radius * cos_limit >= sin_limit * std::sqrt(squared)) {
    return false;  // β ≥ L
  }
  const double least = cos_limit * std::sqrt(squared) + sin_limit * radius;
  // Rounding must not hide anything.
  const double slack = 1e-12 * (1.0 + least);
  for (int i = 0; i < count; ++i) {
    if (to_x.dot(taken[i]) >= least + slack) return true;
  }
  return false;
}

bool FeatureSearch::Direction(const TriangleCorners& corners,
                              const Vector3d& lambda, const Vector3d& x,
                              Vector3d* direction) const noexcept {
  *direction = x - (lambda[0] * corners[0] + lambda[1] * corners[1] +
                    lambda[2] * corners[2]);
  if (direction->norm() <= kOnSurface) {
    *direction =
        (corners[1] - corners[0]).cross(Vector3d(corners[2] - corners[0]));
  }
  *direction = Unit(*direction);
  return direction->squaredNorm() > 0.5;
}

bool FeatureSearch::FindNext(const Vector3d& q, const Vector3d* taken,
                             int count, double cos_limit, double reach,
                             Feature* feature) const noexcept {
  const Vector3d x = bvh_->ToFrame(q);
  if (!IsNear(x)) return false;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double limit = std::min(std::pow(reach * bvh_->scale(), 2),
                                std::numeric_limits<double>::max());
  double nearest = kNone;
  int best = -1;
  Vector3d best_direction = Vector3d::Zero();
  bvh_->tree().NearestFirst(
      limit,
      [&](int index) {
        const BoxTree::Node node = bvh_->ToFrame(bvh_->tree().nodes()[index]);
        const double lower = node.SquaredDistance(x);
        if (lower > std::min(nearest, limit)) return kNone;
        return IsShadowed(index, x, taken, count, cos_limit) ? kNone : lower;
      },
      [&](int position) {
        const TriangleCorners t = bvh_->ToFrame(bvh_->corners()[position]);
        const TrianglePoint p = ClosestOnTriangle(t[0], t[1], t[2], x);
        Vector3d u;
        if (p.squared_distance < nearest && p.squared_distance <= limit &&
            Direction(t, p.lambda, x, &u)) {
          bool is_new = true;
          for (int i = 0; i < count && is_new; ++i) {
            is_new = u.dot(taken[i]) < cos_limit;
          }
          if (is_new) {
            nearest = p.squared_distance;
            best = position;
            best_direction = u;
          }
        }
        return std::min(nearest, limit);
      });
  if (best < 0) return false;
  feature->triangle = bvh_->tree().order()[best];
  feature->distance = std::sqrt(nearest) / bvh_->scale();
  feature->direction = best_direction;
  return true;
}

}  // namespace phongpd
