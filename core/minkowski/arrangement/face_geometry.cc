// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/face_geometry.h"

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
// Grid steps: far above what rounding moves a ray at a box.
constexpr double kRayBoxMargin = 0x1p-4;

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

// A ray and the plane across it, into which everything is projected along the
// ray: where a point lands depends on nothing but the point and the ray.
struct FaceGeometry::Ray {
  Ray(const Vector3d& from_point, const Vector3d& along)
      : from(from_point), direction(along) {
    const int axis = LargestAxis(along);
    u = (axis + 1) % 3;
    v = (axis + 2) % 3;
    w = axis;
    shear_u = along[u] / along[w];
    shear_v = along[v] / along[w];
  }
  Eigen::Vector2d Project(const Vector3d& p) const {
    const double height = p[w] - from[w];
    return {(p[u] - from[u]) - shear_u * height,
            (p[v] - from[v]) - shear_v * height};
  }

  Vector3d from, direction;
  int u = 0, v = 0, w = 0;
  double shear_u = 0.0, shear_v = 0.0;
};

// Ray parameter of the hit, or infinity: parity of the projected border, then
// the plane.  a × b is the negative of b × a to the last bit, so an edge is
// passed on the same side whichever face asks and from whichever end.
double FaceGeometry::Intersect(int face, const Ray& ray) const {
  const ArrangementFace& f = arrangement_.faces[face];
  bool inside = false;
  for (int h = f.begin; h < f.end; ++h) {
    const Eigen::Vector2d a = ray.Project(From(h)), b = ray.Project(To(h));
    if ((a[1] <= 0.0) == (b[1] <= 0.0)) continue;
    const double turn = a[0] * b[1] - a[1] * b[0];
    if (a[1] <= 0.0 ? turn > 0.0 : turn < 0.0) inside = !inside;
  }
  if (!inside) return kMiss;
  double low = kMiss, high = -kMiss;
  for (int h = f.begin; h < f.end; ++h) {
    const double t = (From(h) - ray.from).dot(ray.direction);
    low = std::min(low, t);
    high = std::max(high, t);
  }
  const double squared = ray.direction.squaredNorm();
  const Vector3d n = ToDouble(convolution_.facets[f.facet].normal);
  const double slope = n.dot(ray.direction);
  // Seen edge-on, the plane tells little.
  const double t = slope == 0.0
                       ? 0.5 * (low + high) / squared
                       : std::clamp(n.dot(From(f.begin) - ray.from) / slope,
                                    low / squared, high / squared);
  return t > 0.0 ? t : kMiss;
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
    box.min.array() -= kRayBoxMargin;
    box.max.array() += kRayBoxMargin;
  });
  tree_ = BoxTree(boxes, 4);
}

FaceGeometry::Hit FaceGeometry::FirstHit(const Vector3d& from,
                                         const Vector3d& direction,
                                         double reach, int self) const {
  const Ray ray(from, direction);
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
            const Hit hit{Intersect(face, ray), face};
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
          const Hit hit{Intersect(f, ray), f};
          if (better(hit, best)) best = hit;
        }
        return best;
      },
      [&](const Hit& a, const Hit& b) { return better(b, a) ? b : a; });
}

std::vector<FaceGeometry::Hit> FaceGeometry::AllHits(const Vector3d& from,
                                                     const Vector3d& direction,
                                                     int self) const {
  const Ray ray(from, direction);
  std::vector<Hit> hits;
  const auto visit = [&](int face) {
    const double t = face == self ? kMiss : Intersect(face, ray);
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
