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

// One search of P and x − Q, the pair of nodes with the least bound first.
class SolidGapSearch {
 public:
  SolidGapSearch(const GridSolid& p, const GridSolid& q, const BoxTree& p_tree,
                 const BoxTree& q_tree, const Vector3d& x)
      : p_(p),
        q_(q),
        p_tree_(p_tree),
        q_tree_(q_tree),
        x_(x),
        scale_(ScaleFor(x)) {}

  SolidGap::Nearest FindNearest() {
    queue_.emplace(LowerBound(0, 0), 0, 0);
    while (!queue_.empty()) {
      const auto [bound, i, j] = queue_.top();
      queue_.pop();
      if (bound >= least_) break;
      const BoxTree::Node& a = p_tree_.nodes()[i];
      const BoxTree::Node& b = q_tree_.nodes()[j];
      if (a.IsLeaf() && b.IsLeaf()) {
        CompareLeaves(a, b);
      } else {
        SplitPair(i, j);
      }
    }
    best_.distance = std::sqrt(least_) / scale_;
    return best_;
  }

 private:
  // To coordinates of about the size of one, by a power of two.
  static double ScaleFor(const Vector3d& x) {
    return std::ldexp(
        1.0,
        -std::max(kGridBits, std::ilogb(x.lpNorm<Eigen::Infinity>() + 1.0)));
  }

  // Squared, of all that is below node i of P and node j of Q.
  double LowerBound(int i, int j) const {
    const BoxTree::Node& a = p_tree_.nodes()[i];
    const BoxTree::Node& b = q_tree_.nodes()[j];
    return (scale_ * (a.min + b.min - x_))
        .cwiseMax(scale_ * (x_ - a.max - b.max))
        .cwiseMax(0.0)
        .squaredNorm();
  }

  Corners CornersOfP(int f) const {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = scale_ * ToDouble(p_.vertices[p_.facets[f][k]]);
    }
    return t;
  }

  Corners PlacedCornersOfQ(int f) const {
    Corners t;
    for (std::size_t k = 0; k < 3; ++k) {
      t[k] = scale_ * (x_ - ToDouble(q_.vertices[q_.facets[f][k]]));
    }
    return t;
  }

  void CompareLeaves(const BoxTree::Node& a, const BoxTree::Node& b) {
    for (int k = a.first; k < a.first + a.count; ++k) {
      const int f = p_tree_.order()[k];
      const Corners t = CornersOfP(f);
      for (int l = b.first; l < b.first + b.count; ++l) {
        const int g = q_tree_.order()[l];
        const FacetPair pair = ClosestPoints(t, PlacedCornersOfQ(g));
        if (pair.squared_distance >= least_) continue;
        least_ = pair.squared_distance;
        best_.on_p = pair.on_t / scale_;
        best_.on_q = x_ - pair.on_u / scale_;
        best_.facet_of_p = f;
        best_.facet_of_q = g;
      }
    }
  }

  void SplitPair(int i, int j) {
    const BoxTree::Node& a = p_tree_.nodes()[i];
    const BoxTree::Node& b = q_tree_.nodes()[j];
    const bool splits_p = SplitsFirst(a, b);
    for (int k = 0; k < 2; ++k) {
      const int ci = splits_p ? a.first + k : i;
      const int cj = splits_p ? j : b.first + k;
      const double child = LowerBound(ci, cj);
      if (child < least_) queue_.emplace(child, ci, cj);
    }
  }

  // Lower bound, node of P, node of Q.
  using NodePair = std::tuple<double, int, int>;

  const GridSolid& p_;
  const GridSolid& q_;
  const BoxTree& p_tree_;
  const BoxTree& q_tree_;
  const Vector3d& x_;
  const double scale_;
  std::priority_queue<NodePair, std::vector<NodePair>, std::greater<>> queue_;
  SolidGap::Nearest best_;
  double least_ = std::numeric_limits<double>::infinity();  // squared
};

}  // namespace

SolidGap::SolidGap(const GridSolid& p, const GridSolid& q)
    : p_(p), q_(q), p_tree_(FacetBoxes(p), 4), q_tree_(FacetBoxes(q), 4) {}

SolidGap::Nearest SolidGap::Find(const Vector3d& x) const {
  return SolidGapSearch(p_, q_, p_tree_, q_tree_, x).FindNearest();
}

}  // namespace phongpd::internal
