// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/segment_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/closest_on_triangle.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

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

SegmentReach::SegmentReach(const Vector3d& a, const Vector3d& b, double largest)
    : a_(a),
      min_(a.cwiseMin(b)),
      max_(a.cwiseMax(b)),
      half_(0.5 * b - 0.5 * a),
      direction_(b - a) {
  // Rounding of the cross products below: a few ulps of the coordinates times
  // the other components of the direction.
  const double coordinate =
      std::max({largest, a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()});
  const Vector3d d = half_.cwiseAbs();
  for (int k = 0; k < 3; ++k) {
    slack_[k] = 4e-15 * coordinate * (d[(k + 1) % 3] + d[(k + 2) % 3]) +
                std::numeric_limits<double>::min();
  }
}

// Separating axes: the three of the boxes, exactly, and the three cross
// products with the segment, with slack.
bool SegmentReach::Meets(const BoxTree::Node& node, double margin) const {
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

double SegmentReach::Gap(const BoxTree::Node& node) const {
  return (node.min - max_).cwiseMax(min_ - node.max).cwiseMax(0.0).norm();
}

double SegmentReach::Entry(const BoxTree::Node& node) const {
  double entry = 0.0;
  for (int k = 0; k < 3; ++k) {
    // A segment that does not move along k lies between the two planes.
    if (direction_[k] == 0.0) continue;
    const double wall = direction_[k] > 0.0 ? node.min[k] : node.max[k];
    entry = std::max(entry, (wall - a_[k]) / direction_[k]);
  }
  return std::min(entry, 1.0);
}

bool IsBeyond(const TriangleCorners& t, const Vector3d& a, const Vector3d& b,
              double distance) {
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

double OutlineDistance(const TriangleCorners& t, const Vector3d& a,
                       const Vector3d& b) {
  double squared =
      std::min(ClosestOnTriangle(t[0], t[1], t[2], a).squared_distance,
               ClosestOnTriangle(t[0], t[1], t[2], b).squared_distance);
  for (std::size_t k = 0; k < 3; ++k) {
    squared = std::min(squared, SquaredDistance(a, b, t[k], t[(k + 1) % 3]));
  }
  return std::sqrt(squared);
}

}  // namespace phongpd::internal
