// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/operands/solid_gap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

#include "core/bvh/box_tree_pairs.h"
#include "core/bvh/segment_triangle_distance.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

struct FacetPair {
  Vector3d on_t = Vector3d::Zero(), on_u = Vector3d::Zero();
  double squared_distance = std::numeric_limits<double>::infinity();
};

// Disjoint triangles are closest where an edge of one is closest to the other.
FacetPair ClosestPoints(const Corners& t, const Corners& u) {
  FacetPair best;
  for (int side = 0; side < 2; ++side) {
    const Corners& edges = side == 0 ? t : u;
    const Corners& other = side == 0 ? u : t;
    for (std::size_t k = 0; k < 3; ++k) {
      const SegmentTrianglePair pair = ClosestPair(
          edges[k], edges[(k + 1) % 3], other[0], other[1], other[2]);
      if (pair.squared_distance >= best.squared_distance) continue;
      best.squared_distance = pair.squared_distance;
      best.on_t = side == 0 ? pair.on_segment : pair.on_triangle;
      best.on_u = side == 0 ? pair.on_triangle : pair.on_segment;
    }
  }
  return best;
}

}  // namespace

SolidGap::SolidGap(const GridSolid& p, const GridSolid& q)
    : p_(p), q_(q), p_tree_(FacetBoxes(p), 4), q_tree_(FacetBoxes(q), 4) {}

SolidGap::Nearest SolidGap::Find(const Vector3d& x) const {
  // Coordinates of about the size of one, by a power of two.
  const double scale = std::ldexp(
      1.0, -std::max(kGridBits, std::ilogb(x.lpNorm<Eigen::Infinity>() + 1.0)));
  const auto lower_bound = [&](int i, int j) {
    const BoxTree::Node& a = p_tree_.nodes()[i];
    const BoxTree::Node& b = q_tree_.nodes()[j];
    return (scale * (a.min + b.min - x))
        .cwiseMax(scale * (x - a.max - b.max))
        .cwiseMax(0.0)
        .squaredNorm();
  };
  const auto p_corners = [&](int f) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = scale * ToDouble(p_.vertices[p_.facets[f][k]]);
    }
    return t;
  };
  const auto placed_corners = [&](int f) {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = scale * (x - ToDouble(q_.vertices[q_.facets[f][k]]));
    }
    return t;
  };
  using Entry = std::tuple<double, int, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.emplace(lower_bound(0, 0), 0, 0);
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  while (!queue.empty()) {
    const auto [bound, i, j] = queue.top();
    queue.pop();
    if (bound >= least) break;
    const BoxTree::Node& a = p_tree_.nodes()[i];
    const BoxTree::Node& b = q_tree_.nodes()[j];
    if (a.IsLeaf() && b.IsLeaf()) {
      for (int k = a.first; k < a.first + a.count; ++k) {
        const int f = p_tree_.order()[k];
        const Corners t = p_corners(f);
        for (int l = b.first; l < b.first + b.count; ++l) {
          const int g = q_tree_.order()[l];
          const FacetPair pair = ClosestPoints(t, placed_corners(g));
          if (pair.squared_distance >= least) continue;
          least = pair.squared_distance;
          best.on_p = pair.on_t / scale;
          best.on_q = x - pair.on_u / scale;
          best.facet_of_p = f;
          best.facet_of_q = g;
        }
      }
      continue;
    }
    const bool splits_p = SplitsFirst(a, b);
    for (int k = 0; k < 2; ++k) {
      const int ci = splits_p ? a.first + k : i;
      const int cj = splits_p ? j : b.first + k;
      const double child = lower_bound(ci, cj);
      if (child < least) queue.emplace(child, ci, cj);
    }
  }
  best.distance = std::sqrt(least) / scale;
  return best;
}

}  // namespace phongpd::internal
