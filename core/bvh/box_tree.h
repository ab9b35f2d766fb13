// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <utility>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A binary tree of axis-aligned boxes over items 0 … n−1, flat in memory.
// It stores boxes and item numbers only; what is searched for is decided by
// the functors of the two traversals, which neither allocate nor call
// virtually.  Built by binned surface-area splits, by medians below
// kSplitDepth, so that a path is never longer than kMaxDepth.
class BoxTree {
 public:
  struct Node {
    Eigen::Vector3d min;
    Eigen::Vector3d max;
    int first = 0;  // leaf: position in order(); otherwise the left child,
                    // whose sibling is first + 1 (both after the parent)
    int count = 0;  // leaf: number of items; 0 otherwise

    bool IsLeaf() const { return count > 0; }
    double SquaredDistance(const Eigen::Vector3d& x) const {
      return (min - x).cwiseMax(x - max).cwiseMax(0.0).squaredNorm();
    }
  };

  static constexpr int kSplitDepth = 40;
  static constexpr int kMaxDepth = 80;

  BoxTree() = default;
  // Boxes must be finite and non-empty; leaves hold at most `leaf_size`.
  BoxTree(const std::vector<BoundingBox>& boxes, int leaf_size);

  const std::vector<Node>& nodes() const { return nodes_; }
  // Items in leaf order.
  const std::vector<int>& order() const { return order_; }

  // Visits the items of every leaf all of whose ancestors pass
  // keep(node index) → bool.  visit(position in order()) → bool; false stops.
  template <typename Keep, typename Visit>
  void ForEach(const Keep& keep, const Visit& visit) const {
    if (nodes_.empty() || !keep(0)) return;
    int stack[kMaxDepth];
    int size = 0;
    for (int index = 0;;) {
      const Node& node = nodes_[index];
      if (node.IsLeaf()) {
        for (int i = node.first; i < node.first + node.count; ++i) {
          if (!visit(i)) return;
        }
      } else {
        if (keep(node.first + 1)) stack[size++] = node.first + 1;
        if (keep(node.first)) stack[size++] = node.first;
      }
      if (size == 0) return;
      index = stack[--size];
    }
  }

  // Depth first, nearer child first.  bound(node index) → lower bound of what
  // visit can find below the node (infinity: nothing); visit(position)
  // → the least value found so far.  Nodes with a larger bound are skipped.
  template <typename Bound, typename Visit>
  void NearestFirst(double limit, const Bound& bound,
                    const Visit& visit) const {
    if (nodes_.empty()) return;
    std::pair<double, int> stack[kMaxDepth];
    int size = 0;
    stack[size++] = {bound(0), 0};
    while (size > 0) {
      const auto [lower, index] = stack[--size];
      if (!(lower <= limit)) continue;
      const Node& node = nodes_[index];
      if (node.IsLeaf()) {
        for (int i = node.first; i < node.first + node.count; ++i) {
          limit = visit(i);
        }
        continue;
      }
      std::pair<double, int> near(bound(node.first), node.first);
      std::pair<double, int> far(bound(node.first + 1), node.first + 1);
      if (far.first < near.first) std::swap(near, far);
      if (far.first <= limit) stack[size++] = far;
      if (near.first <= limit) stack[size++] = near;
    }
  }

 private:
  std::vector<Node> nodes_;
  std::vector<int> order_;
};

}  // namespace phongpd
