// SPDX-License-Identifier: GPL-3.0-or-later
// Questions about segments.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/bvh/triangle_bvh.h"

namespace phongpd {

using Eigen::Vector3d;
using internal::IsBeyond;
using internal::OutlineDistance;
using internal::SegmentReach;

double TriangleBvh::Distance(const Vector3d& a, const Vector3d& b,
                             double limit) const noexcept {
  const SegmentReach reach(a, b, largest_);
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
        const TriangleCorners& t = corners_[position];
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

bool TriangleBvh::ComesWithin(const Vector3d& a, const Vector3d& b,
                              double distance) const noexcept {
  const SegmentReach reach(a, b, largest_);
  bool found = false;
  tree_.ForEach(
      [&](int node) { return reach.Meets(tree_.nodes()[node], distance); },
      [&](int position) {
        const TriangleCorners& t = corners_[position];
        double fraction = 1.0;
        found = !IsBeyond(t, a, b, distance) &&
                (MeetsTriangle(t, a, b, &fraction) ||
                 OutlineDistance(t, a, b) < distance);
        return !found;
      });
  return found;
}

bool TriangleBvh::Meets(const Vector3d& a, const Vector3d& b) const noexcept {
  const SegmentReach reach(a, b, largest_);
  bool meets = false;
  tree_.ForEach([&](int node) { return reach.Meets(tree_.nodes()[node]); },
                [&](int position) {
                  double fraction = 1.0;
                  meets = MeetsTriangle(corners_[position], a, b, &fraction);
                  return !meets;
                });
  return meets;
}

TriangleBvh::Hit TriangleBvh::First(const Vector3d& a, const Vector3d& b,
                                    double radius) const noexcept {
  const SegmentReach reach(a, b, largest_);
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
        const TriangleCorners& t = corners_[position];
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

TriangleBvh::Hit TriangleBvh::FirstHit(const Vector3d& a,
                                       const Vector3d& b) const noexcept {
  return First(a, b, -1.0);
}

TriangleBvh::Hit TriangleBvh::FirstHitBeyond(const Vector3d& a,
                                             const Vector3d& b,
                                             double radius) const noexcept {
  return First(a, b, radius);
}

}  // namespace phongpd
