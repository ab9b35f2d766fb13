// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/face_geometry.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <cmath>

namespace phongpd::internal {

using Eigen::Vector3d;

double FaceGeometry::Area(int face) const {
  const ArrangementFace& f = arrangement_.faces[face];
  const Vector3d& origin = From(f.begin);
  Vector3d sum = Vector3d::Zero();
  for (int h = f.begin; h < f.end; ++h) {
    sum += (From(h) - origin).cross(To(h) - origin);
  }
  return 0.5 * sum.norm();
}

Vector3d FaceGeometry::Normal(int face) const {
  const int facet = arrangement_.faces[face].facet;
  return ToDouble(convolution_.facets[facet].normal).normalized();
}

// Half way from the middle of the longest edge to the opposite border.
Vector3d FaceGeometry::InteriorPoint(int face) const {
  const ArrangementFace& f = arrangement_.faces[face];
  int longest = f.begin;
  for (int h = f.begin; h < f.end; ++h) {
    if ((To(h) - From(h)).squaredNorm() >
        (To(longest) - From(longest)).squaredNorm()) {
      longest = h;
    }
  }
  const Vector3d middle = 0.5 * (From(longest) + To(longest));
  const Vector3d along = (To(longest) - From(longest)).normalized();
  const Vector3d inward = Normal(face).cross(along);
  double reach = std::numeric_limits<double>::infinity();
  for (int h = f.begin; h < f.end; ++h) {
    const Vector3d a = From(h) - middle, b = To(h) - middle;
    const double ua = a.dot(along), ub = b.dot(along);
    if ((ua < 0) == (ub < 0)) continue;
    const double t = ua / (ua - ub);
    const double distance = (a + t * (b - a)).dot(inward);
    if (h != longest && distance > 0) reach = std::min(reach, distance);
  }
  if (!std::isfinite(reach)) reach = 0.0;
  return middle + 0.5 * reach * inward;
}

// Ray parameter of the hit, or infinity: plane, then parity of the border in
// the plane's dominant projection.
double FaceGeometry::Intersect(int face, const Vector3d& from,
                               const Vector3d& direction) const {
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const ArrangementFace& f = arrangement_.faces[face];
  const Vector3d n =
      ToDouble(convolution_.facets[arrangement_.faces[face].facet].normal);
  const double slope = n.dot(direction);
  if (slope == 0.0) return kMiss;
  const double t = n.dot(From(f.begin) - from) / slope;
  if (!(t > 0)) return kMiss;
  const Vector3d p = from + t * direction;
  const int axis = LargestAxis(n), u = (axis + 1) % 3, v = (axis + 2) % 3;
  bool inside = false;
  for (int h = f.begin; h < f.end; ++h) {
    const Vector3d &a = From(h), &b = To(h);
    if ((a[v] <= p[v]) == (b[v] <= p[v])) continue;
    if (a[u] + (b[u] - a[u]) * ((p[v] - a[v]) / (b[v] - a[v])) > p[u]) {
      inside = !inside;
    }
  }
  return inside ? t : kMiss;
}

FaceGeometry::Hit FaceGeometry::FirstHit(const Vector3d& from,
                                         const Vector3d& direction,
                                         int self) const {
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, FaceCount(), 2048), Hit(),
      [&](const tbb::blocked_range<int>& range, Hit best) {
        for (int f = range.begin(); f < range.end(); ++f) {
          if (f == self) continue;
          const double t = Intersect(f, from, direction);
          if (t < best.distance) best = {t, f};
        }
        return best;
      },
      [](const Hit& a, const Hit& b) {
        return a.distance < b.distance ||
                       (a.distance == b.distance && a.face < b.face)
                   ? a
                   : b;
      });
}

}  // namespace phongpd::internal
