// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/segment_triangle_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "core/bvh/triangle_bvh.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

void Offer(const Vector3d& on_segment, const Vector3d& on_triangle,
           SegmentTrianglePair* best) {
  const double squared = (on_segment - on_triangle).squaredNorm();
  if (!(squared < best->squared_distance)) return;
  *best = {on_segment, on_triangle, squared};
}

void OfferEnd(const Vector3d& x, const Corners& t, SegmentTrianglePair* best) {
  const Vector3d lambda = ClosestOnTriangle(t[0], t[1], t[2], x).lambda;
  Offer(x, t[0] + lambda[1] * (t[1] - t[0]) + lambda[2] * (t[2] - t[0]), best);
}

void OfferCorner(const Vector3d& a, const Vector3d& along, const Vector3d& x,
                 SegmentTrianglePair* best) {
  const double squared = along.squaredNorm();
  const double mu =
      squared > 0.0 ? std::clamp(along.dot(x - a) / squared, 0.0, 1.0) : 0.0;
  Offer(a + mu * along, x, best);
}

// Where the lines are closest; nothing if that is beyond one of the segments,
// as an end of it then does at least as well.
void OfferEdge(const Vector3d& a, const Vector3d& along, const Vector3d& p,
               const Vector3d& edge, SegmentTrianglePair* best) {
  const Vector3d normal = along.cross(edge);
  const double squared = normal.squaredNorm();
  if (!(squared > 0.0)) return;
  const Vector3d between = p - a;
  const double s = between.cross(edge).dot(normal) / squared;
  const double t = between.cross(along).dot(normal) / squared;
  if (!(s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0)) return;
  Offer(a + s * along, p + t * edge, best);
}

// Where the segment passes through the triangle's plane, if inside it.
void OfferCrossing(const Vector3d& a, const Vector3d& b, const Corners& t,
                   SegmentTrianglePair* best) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double height_a = normal.dot(a - t[0]);
  const double height_b = normal.dot(b - t[0]);
  if (!(height_a * height_b < 0.0)) return;
  const Vector3d x = a + height_a / (height_a - height_b) * (b - a);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& from = t[k];
    if ((t[(k + 1) % 3] - from).cross(x - from).dot(normal) < 0.0) return;
  }
  Offer(x, x, best);
}

}  // namespace

SegmentTrianglePair ClosestPair(const Vector3d& a, const Vector3d& b,
                                const Vector3d& p, const Vector3d& q,
                                const Vector3d& r) noexcept {
  const Corners t = {p, q, r};
  const Vector3d along = b - a;
  SegmentTrianglePair best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  OfferCrossing(a, b, t, &best);
  if (best.squared_distance == 0.0) return best;
  OfferEnd(a, t, &best);
  OfferEnd(b, t, &best);
  for (std::size_t k = 0; k < 3; ++k) {
    OfferCorner(a, along, t[k], &best);
    OfferEdge(a, along, t[k], t[(k + 1) % 3] - t[k], &best);
  }
  return best;
}

}  // namespace phongpd
