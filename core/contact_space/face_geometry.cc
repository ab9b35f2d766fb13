// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/face_geometry.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpd::internal {

using Eigen::Vector3d;

namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

// Where the ray enters the box, or infinity.  A direction component of zero
// is handled apart: 0 · ∞ is not a number.
double EnterBox(const Vector3d& low, const Vector3d& high, const Vector3d& from,
                const Vector3d& direction) {
  double enter = 0.0, leave = kMiss;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (from[k] < low[k] || from[k] > high[k]) return kMiss;
      continue;
    }
    const double a = (low[k] - from[k]) / direction[k];
    const double b = (high[k] - from[k]) / direction[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kMiss;
}

}  // namespace

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

// From a point of the longest edge part of the way to the opposite border.
// The fractions are no simple ones: on lattice-like solids a ray from the very
// middle would run exactly into edges and could pass between two faces.
Vector3d FaceGeometry::InteriorPoint(int face) const {
  const ArrangementFace& f = arrangement_.faces[face];
  int longest = f.begin;
  for (int h = f.begin; h < f.end; ++h) {
    if ((To(h) - From(h)).squaredNorm() >
        (To(longest) - From(longest)).squaredNorm()) {
      longest = h;
    }
  }
  const Vector3d middle =
      From(longest) + 0.43711 * (To(longest) - From(longest));
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
  return middle + 0.38174 * reach * inward;
}

// Ray parameter of the hit, or infinity: plane, then parity of the border in
// the plane's dominant projection.
double FaceGeometry::Intersect(int face, const Vector3d& from,
                               const Vector3d& direction) const {
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

void FaceGeometry::BuildTree() {
  std::vector<BoundingBox> boxes(arrangement_.faces.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t f) {
    const ArrangementFace& face = arrangement_.faces[f];
    BoundingBox& box = boxes[f];
    box.min = box.max = From(face.begin);
    for (int h = face.begin; h < face.end; ++h) {
      box.min = box.min.cwiseMin(From(h));
      box.max = box.max.cwiseMax(From(h));
    }
  });
  tree_ = BoxTree(boxes, 4);
}

FaceGeometry::Hit FaceGeometry::FirstHit(const Vector3d& from,
                                         const Vector3d& direction,
                                         double reach, int self) const {
  const auto better = [](const Hit& a, const Hit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
  };
  if (!tree_.nodes().empty()) {
    Hit best{reach, -1};
    tree_.NearestFirst(
        reach,
        [&](int index) {
          const BoxTree::Node& node = tree_.nodes()[index];
          return EnterBox(node.min, node.max, from, direction);
        },
        [&](int position) {
          const int face = tree_.order()[position];
          if (face != self) {
            const Hit hit{Intersect(face, from, direction), face};
            if (better(hit, best)) best = hit;
          }
          return best.distance;
        });
    return best;
  }
  return tbb::parallel_reduce(
      tbb::blocked_range<int>(0, FaceCount(), 2048), Hit{reach, -1},
      [&](const tbb::blocked_range<int>& range, Hit best) {
        for (int f = range.begin(); f < range.end(); ++f) {
          if (f == self) continue;
          const Hit hit{Intersect(f, from, direction), f};
          if (better(hit, best)) best = hit;
        }
        return best;
      },
      [&](const Hit& a, const Hit& b) { return better(b, a) ? b : a; });
}

std::vector<FaceGeometry::Hit> FaceGeometry::AllHits(const Vector3d& from,
                                                     const Vector3d& direction,
                                                     int self) const {
  std::vector<Hit> hits;
  const auto visit = [&](int face) {
    const double t = face == self ? kMiss : Intersect(face, from, direction);
    if (t < kMiss) hits.push_back({t, face});
  };
  if (tree_.nodes().empty()) {
    for (int f = 0; f < FaceCount(); ++f) visit(f);
  } else {
    tree_.ForEach(
        [&](int index) {
          const BoxTree::Node& node = tree_.nodes()[index];
          return EnterBox(node.min, node.max, from, direction) < kMiss;
        },
        [&](int position) {
          visit(tree_.order()[position]);
          return true;
        });
  }
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
  });
  return hits;
}

}  // namespace phongpd::internal
