// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/closest_on_triangle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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

// Offers the foot of the perpendicular on a triangle so thin that its normal
// has few correct digits: relative to the longest edge e, across it and then
// along it, each from differences of the triangle's own thickness.
void OfferSliver(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                 const Vector3d& x, TrianglePoint* best) {
  const std::array<Vector3d, 3> corner = {a, b, c};
  int i = 0;  // e runs from corner i to corner i + 1
  for (int k = 1; k < 3; ++k) {
    if ((corner[(k + 1) % 3] - corner[k]).squaredNorm() >
        (corner[(i + 1) % 3] - corner[i]).squaredNorm()) {
      i = k;
    }
  }
  const int j = (i + 1) % 3, apex = (i + 2) % 3;
  const Vector3d e = corner[j] - corner[i];
  const Vector3d to_apex = corner[apex] - corner[i], to_x = x - corner[i];
  const double squared = e.squaredNorm();
  if (!(squared > 0.0)) return;
  const double along_apex = to_apex.dot(e) / squared;
  const double along_x = to_x.dot(e) / squared;
  const Vector3d height = to_apex - along_apex * e;
  const double tall = height.squaredNorm();
  if (!(tall > 0.0)) return;
  const double across = (to_x - along_x * e).dot(height) / tall;
  const double along = along_x - across * along_apex;
  if (!(across >= 0.0 && along >= 0.0 && across + along <= 1.0)) return;
  best->squared_distance = (to_x - along * e - across * to_apex).squaredNorm();
  best->lambda[i] = std::max(0.0, 1.0 - across - along);
  best->lambda[j] = along;
  best->lambda[apex] = across;
}

}  // namespace

TrianglePoint ClosestOnTriangle(const Vector3d& a, const Vector3d& b,
                                const Vector3d& c, const Vector3d& x) noexcept {
  const Vector3d ab = b - a, ac = c - a, ax = x - a;
  const Vector3d normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  TrianglePoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  const double longest = std::max(ab.squaredNorm(), ac.squaredNorm());
  if (!(squared > 1e-8 * longest * longest)) {
    OfferSliver(a, b, c, x, &best);
    OfferEdge(0, 1, ab, ax, &best);
    OfferEdge(0, 2, ac, ax, &best);
    OfferEdge(1, 2, c - b, x - b, &best);
  } else {
    const double l1 = ax.cross(ac).dot(normal);
    const double l2 = ab.cross(ax).dot(normal);
    if (l1 >= 0.0 && l2 >= 0.0 && l1 + l2 <= squared) {
      const double m1 = l1 / squared, m2 = l2 / squared;
      best.lambda = {std::max(0.0, 1.0 - m1 - m2), m1, m2};
      best.squared_distance = (ax - m1 * ab - m2 * ac).squaredNorm();
      return best;
    }
    // On an edge that the foot lies beyond: the way from x to a point of any
    // other crosses one of these.
    if (!(l2 >= 0.0)) OfferEdge(0, 1, ab, ax, &best);
    if (!(l1 >= 0.0)) OfferEdge(0, 2, ac, ax, &best);
    if (!(l1 + l2 <= squared)) OfferEdge(1, 2, c - b, x - b, &best);
  }
  return best;
}

}  // namespace phongpd
