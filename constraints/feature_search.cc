// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/feature_search.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/mesh/surface_tree.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

constexpr double kOnSurface = 1e-12;
// Farther away than this many diagonals squares lose their meaning, and no
// two points of the surface are a millionth of a degree apart.
constexpr double kFar = 1e8;

}  // namespace

FeatureSearch::FeatureSearch(const TriangleMesh& mesh) {
  const BoundingBox bounds = ComputeBounds(mesh);
  center_ = bounds.Center();
  const double diagonal = bounds.Diagonal();
  if (diagonal > 0.0) scale_ = std::ldexp(1.0, -std::ilogb(diagonal));
  std::vector<Corners> corners;
  std::vector<BoundingBox> boxes;
  for (const Triangle& t : mesh.triangles) {
    Corners q;
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] = (mesh.vertices[t[k]] - center_) * scale_;
    }
    corners.push_back(q);
    boxes.push_back({q[0].cwiseMin(q[1]).cwiseMin(q[2]),
                     q[0].cwiseMax(q[1]).cwiseMax(q[2])});
  }
  tree_ = BoxTree(boxes, 2);
  for (const int item : tree_.order()) corners_.push_back(corners[item]);
}

bool FeatureSearch::IsShadowed(const BoxTree::Node& node, const Vector3d& x,
                               const Vector3d* taken, int count,
                               double cos_limit) const noexcept {
  const Vector3d to_x = x - 0.5 * (node.min + node.max);
  const double distance = to_x.norm();
  const double radius = 0.5 * (node.max - node.min).norm();
  // The ball around the box is seen under the half angle β; it stays in the
  // cone of half angle L if its centre's angle is at most L − β.
  const double sin_beta = radius / distance;
  const double sin_limit = std::sqrt(1.0 - cos_limit * cos_limit);
  if (!(sin_beta < sin_limit)) return false;
  const double cos_beta = std::sqrt(1.0 - sin_beta * sin_beta);
  const double least = cos_limit * cos_beta + sin_limit * sin_beta + 1e-12;
  for (int i = 0; i < count; ++i) {
    if (to_x.dot(taken[i]) >= least * distance) return true;
  }
  return false;
}

bool FeatureSearch::Direction(const Corners& corners, const Vector3d& lambda,
                              const Vector3d& x,
                              Vector3d* direction) const noexcept {
  *direction = x - (lambda[0] * corners[0] + lambda[1] * corners[1] +
                    lambda[2] * corners[2]);
  if (direction->norm() <= kOnSurface) {
    *direction =
        (corners[1] - corners[0]).cross(Vector3d(corners[2] - corners[0]));
  }
  direction->stableNormalize();
  return direction->squaredNorm() > 0.5;
}

bool FeatureSearch::FindNext(const Vector3d& q, const Vector3d* taken,
                             int count, double cos_limit,
                             Feature* feature) const noexcept {
  const Vector3d x = (q - center_) * scale_;
  // The negation catches NaN, too.
  if (!(x.cwiseAbs().maxCoeff() <= kFar)) return false;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  double nearest = kNone;
  int best = -1;
  Vector3d best_direction = Vector3d::Zero();
  tree_.NearestFirst(
      std::numeric_limits<double>::max(),
      [&](int index) {
        const BoxTree::Node& node = tree_.nodes()[index];
        const double lower = node.SquaredDistance(x);
        if (lower > nearest) return kNone;
        return IsShadowed(node, x, taken, count, cos_limit) ? kNone : lower;
      },
      [&](int position) {
        const Corners& t = corners_[position];
        const TrianglePoint p = ClosestOnTriangle(t[0], t[1], t[2], x);
        Vector3d u;
        if (p.squared_distance < nearest && Direction(t, p.lambda, x, &u)) {
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
        return std::min(nearest, std::numeric_limits<double>::max());
      });
  if (best < 0) return false;
  feature->triangle = tree_.order()[best];
  feature->distance = std::sqrt(nearest) / scale_;
  feature->direction = best_direction;
  return true;
}

}  // namespace phongpd
