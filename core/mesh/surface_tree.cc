// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/surface_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd {

namespace {

using Eigen::Vector3d;

// Offers the point of segment (i, j) closest to x; `edge` = q_j − q_i and
// `to_x` = x − q_i.
void OfferEdge(int i, int j, const Vector3d& edge, const Vector3d& to_x,
               TrianglePoint* best) {
  const double squared = edge.squaredNorm();
  const double mu =
      squared > 0.0 ? std::clamp(to_x.dot(edge) / squared, 0.0, 1.0) : 0.0;
  const double distance = (to_x - mu * edge).squaredNorm();
  if (!(distance < best->squared_distance)) return;
  best->squared_distance = distance;
  best->lambda.setZero();
  best->lambda[i] = 1.0 - mu;
  best->lambda[j] = mu;
}

}  // namespace

TrianglePoint ClosestOnTriangle(const Vector3d& a, const Vector3d& b,
                                const Vector3d& c, const Vector3d& x) noexcept {
  const Vector3d ab = b - a, ac = c - a, ax = x - a;
  const Vector3d normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  TrianglePoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  const double l1 = ax.cross(ac).dot(normal);
  const double l2 = ab.cross(ax).dot(normal);
  const bool over_face = l1 >= 0.0 && l2 >= 0.0 && l1 + l2 <= squared;
  if (over_face && squared > 0.0) {
    const double m1 = l1 / squared, m2 = l2 / squared;
    best.lambda = {std::max(0.0, 1.0 - m1 - m2), m1, m2};
    best.squared_distance = (ax - m1 * ab - m2 * ac).squaredNorm();
    // Only in a sliver can rounding make an edge closer.
    const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
    if (squared > 1e-8 * longest * longest) return best;
  }
  OfferEdge(0, 1, ab, ax, &best);
  OfferEdge(0, 2, ac, ax, &best);
  OfferEdge(1, 2, c - b, x - b, &best);
  return best;
}

SurfaceTree::SurfaceTree(const TriangleMesh& mesh) {
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
  for (int item : tree_.order()) {
    corners_.push_back(corners[item]);
  }
}

SurfaceTree::Closest SurfaceTree::FindClosest(
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
      [&](int index) { return tree_.nodes()[index].SquaredDistance(x); },
      [&](int position) {
        const Corners& t = corners_[position];
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
