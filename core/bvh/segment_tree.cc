// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/segment_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/surface_tree.h"
#include "core/bvh/triangle_corners.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

// Of the segments ab and cd (Ericson, Real-Time Collision Detection, 5.1.9,
// with cross products, which lose no digits when they are nearly parallel).
double SquaredDistance(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                       const Vector3d& d) {
  const Vector3d u = b - a, v = d - c, w = c - a;
  const Vector3d normal = u.cross(v);
  const double squared = normal.squaredNorm();
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  double s = squared > 1e-28 * uu * vv
                 ? std::clamp(w.cross(v).dot(normal) / squared, 0.0, 1.0)
                 : 0.0;
  const double t =
      vv > 0.0 ? std::clamp((s * u - w).dot(v) / vv, 0.0, 1.0) : 0.0;
  if (uu > 0.0) s = std::clamp((w + t * v).dot(u) / uu, 0.0, 1.0);
  return (w + t * v - s * u).squaredNorm();
}

}  // namespace

SegmentTree::SegmentTree(const TriangleMesh& mesh) : corners_(CornersOf(mesh)) {
  for (const Corners& t : corners_) {
    for (const Vector3d& v : t) {
      largest_ = std::max(largest_, v.cwiseAbs().maxCoeff());
    }
  }
  tree_ = SortIntoTree(&corners_);
}

SegmentTree::Reach::Reach(const SegmentTree& tree, const Vector3d& a,
                          const Vector3d& b)
    : a_(a),
      min_(a.cwiseMin(b)),
      max_(a.cwiseMax(b)),
      half_(0.5 * b - 0.5 * a),
      direction_(b - a) {
  // Rounding of the cross products below: a few ulps of the coordinates times
  // the other components of the direction.
  const double coordinate = std::max(
      {tree.largest_, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
  const Vector3d d = half_.cwiseAbs();
  for (int k = 0; k < 3; ++k) {
    slack_[k] = 4e-15 * coordinate * (d[(k + 1) % 3] + d[(k + 2) % 3]) +
                std::numeric_limits<double>::min();
  }
}

// Separating axes: the three of the boxes, exactly, and the three cross
// products with the segment, with slack.
bool SegmentTree::Reach::Meets(const BoxTree::Node& node, double margin) const {
  if ((node.max.array() + margin < min_.array()).any() ||
      (max_.array() < node.min.array() - margin).any()) {
    return false;
  }
  const Vector3d c =
      (0.5 * min_ + 0.5 * max_) - (0.5 * node.min + 0.5 * node.max);
  const Vector3d h =
      (0.5 * node.max - 0.5 * node.min).array() + margin * (1.0 + 1e-15);
  const Vector3d d = half_.cwiseAbs();
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    if (std::abs(c[u] * half_[v] - c[v] * half_[u]) >
        h[u] * d[v] + h[v] * d[u] + slack_[k]) {
      return false;
    }
  }
  return true;
}

double SegmentTree::Reach::Gap(const BoxTree::Node& node) const {
  return (node.min - max_).cwiseMax(min_ - node.max).cwiseMax(0.0).norm();
}

double SegmentTree::Reach::Entry(const BoxTree::Node& node) const {
  double entry = 0.0;
  for (int k = 0; k < 3; ++k) {
    // A segment that does not move along k lies between the two planes.
    if (direction_[k] == 0.0) continue;
    const double wall = direction_[k] > 0.0 ? node.min[k] : node.max[k];
    entry = std::max(entry, (wall - a_[k]) / direction_[k]);
  }
  return std::min(entry, 1.0);
}

// Does the triangle's plane alone keep the segment further away than
// `distance`?  Of most triangles near a segment it does.
bool SegmentTree::IsBeyond(const Corners& t, const Vector3d& a,
                           const Vector3d& b, double distance) {
  const Vector3d u = t[1] - t[0], v = t[2] - t[0], to_a = a - t[0],
                 to_b = b - t[0];
  const Vector3d normal = u.cross(v);
  const double at_a = normal.dot(to_a), at_b = normal.dot(to_b);
  if (!(at_a * at_b > 0.0)) return false;
  const double nearer = std::min(std::abs(at_a), std::abs(at_b));
  // Only where rounding cannot matter: no slivers, and not far away.
  const double squared = normal.squaredNorm();
  const double longest = std::max(u.squaredNorm(), v.squaredNorm());
  const double reach = std::max(to_a.squaredNorm(), to_b.squaredNorm());
  return squared > 1e-6 * longest * longest &&
         nearer * nearer >
             squared * std::max(1.0001 * distance * distance, 1e-24 * reach);
}

double SegmentTree::OutlineDistance(const Corners& t, const Vector3d& a,
                                    const Vector3d& b) {
  double squared =
      std::min(ClosestOnTriangle(t[0], t[1], t[2], a).squared_distance,
               ClosestOnTriangle(t[0], t[1], t[2], b).squared_distance);
  for (std::size_t k = 0; k < 3; ++k) {
    squared = std::min(squared, SquaredDistance(a, b, t[k], t[(k + 1) % 3]));
  }
  return std::sqrt(squared);
}

double SegmentTree::Distance(const Vector3d& a, const Vector3d& b,
                             double limit) const noexcept {
  const Reach reach(*this, a, b);
  double least = limit;
  tree_.NearestFirst(
      limit,
      [&](int index) {
        const BoxTree::Node& node = tree_.nodes()[index];
        const double gap = reach.Gap(node);
        return gap <= least && (std::isinf(least) || reach.Meets(node, least))
                   ? gap
                   : std::numeric_limits<double>::infinity();
      },
      [&](int position) {
        const Corners& t = corners_[position];
        double fraction = 1.0;
        if (IsBeyond(t, a, b, least)) return least;
        if (MeetsTriangle(t, a, b, &fraction)) {
          least = 0.0;
        } else if (least > 0.0) {
          // Positive where they do not meet, whatever the rounding.
          least = std::min(least, std::max(OutlineDistance(t, a, b),
                                           std::numeric_limits<double>::min()));
        }
        return least;
      });
  return least;
}

bool SegmentTree::ComesWithin(const Vector3d& a, const Vector3d& b,
                              double distance) const noexcept {
  const Reach reach(*this, a, b);
  bool found = false;
  tree_.ForEach(
      [&](int node) { return reach.Meets(tree_.nodes()[node], distance); },
      [&](int position) {
        const Corners& t = corners_[position];
        double fraction = 1.0;
        found = !IsBeyond(t, a, b, distance) &&
                (MeetsTriangle(t, a, b, &fraction) ||
                 OutlineDistance(t, a, b) < distance);
        return !found;
      });
  return found;
}

bool SegmentTree::Meets(const Vector3d& a, const Vector3d& b) const noexcept {
  const Reach reach(*this, a, b);
  bool meets = false;
  tree_.ForEach([&](int node) { return reach.Meets(tree_.nodes()[node]); },
                [&](int position) {
                  double fraction = 1.0;
                  meets = MeetsTriangle(corners_[position], a, b, &fraction);
                  return !meets;
                });
  return meets;
}

SegmentTree::Hit SegmentTree::First(const Vector3d& a, const Vector3d& b,
                                    double radius) const noexcept {
  const Reach reach(*this, a, b);
  const double length = (b - a).norm();
  Hit first;
  tree_.NearestFirst(
      1.0,
      [&](int index) {
        const BoxTree::Node& node = tree_.nodes()[index];
        return reach.Meets(node) ? reach.Entry(node)
                                 : std::numeric_limits<double>::infinity();
      },
      [&](int position) {
        const Corners& t = corners_[position];
        double fraction = 1.0;
        if (MeetsTriangle(t, a, b, &fraction) &&
            (!first.Found() || fraction < first.fraction) &&
            !(radius >= 0.0 &&
              // The hit itself bounds the distance, better than the closest
              // point does on a sliver.
              (fraction * length <= radius ||
               ClosestOnTriangle(t[0], t[1], t[2], a).squared_distance <=
                   radius * radius))) {
          first = {tree_.order()[position], fraction};
        }
        return first.fraction;
      });
  return first;
}

SegmentTree::Hit SegmentTree::FirstHit(const Vector3d& a,
                                       const Vector3d& b) const noexcept {
  return First(a, b, -1.0);
}

SegmentTree::Hit SegmentTree::FirstHitBeyond(const Vector3d& a,
                                             const Vector3d& b,
                                             double radius) const noexcept {
  return First(a, b, radius);
}

}  // namespace phongpd
