// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/projection/field_projector.h"

namespace phongpd {

// The triangles of a field by where they lie and where their normals point, in
// nodes of four, for points x inside (field frame, |x_i| ≤ 2).
//
// A projection p − x = t·n, t = −s ≥ 0, below a node whose triangles lie in
// the box [b, B] and whose vertex normals lie in the box [m, M] satisfies in
// every coordinate
//
//   t·m ≤ B − x   and   t·M ≥ b − x,
//
// six inequalities linear in t.  They leave an interval [t₀, t₁] or nothing,
// and the depth t·|n| is at least t₀·min|n| and at least the distance of the
// box.  Four children are bounded at once, in floats: boxes are widened by far
// more than these round, so that what is left out holds no projection whatever
// a projector accepts by its own tolerances.  For the tangent-plane field, and
// where |n(λ)| < 1e-3, [m, M] is all directions and only the distance counts.
class PrismTree {
 public:
  // t in [least, most] holds every projection below a node.
  struct Offsets {
    double least = 0.0;
    double most = 0.0;
  };

  PrismTree() = default;
  explicit PrismTree(const FieldProjector& projector);

  // Depth first, child with the least bound first.  visit(triangle, offsets)
  // → the least depth that is still of interest, `limit` before the first;
  // triangles whose depth is surely larger are skipped.
  template <typename Visit>
  void NearestFirst(const Eigen::Vector3d& x, double limit,
                    const Visit& visit) const {
    const Place place = PlaceOf(x);
    std::array<Entry, kStack> stack;
    std::size_t size = 0;
    float most = SquaredLimit(limit);
    if (!nodes_.empty()) size = Push(nodes_[0], place, most, stack.data(), 0);
    while (size > 0) {
      const Entry entry = stack[--size];
      if (entry.squared_bound > most) continue;
      if (entry.child >= 0) {
        size = Push(nodes_[entry.child], place, most, stack.data(), size);
      } else {
        most = SquaredLimit(visit(~entry.child, OffsetsOf(entry)));
      }
    }
  }

  // visit(triangle, offsets) for every triangle that may hold a projection of
  // depth ≤ limit, in no particular order.
  template <typename Visit>
  void ForEach(const Eigen::Vector3d& x, double limit,
               const Visit& visit) const {
    NearestFirst(x, limit, [&](int triangle, const Offsets& offsets) {
      visit(triangle, offsets);
      return limit;
    });
  }

 private:
  // Vector extension of gcc and clang: plain arithmetic on every machine.
  using Four = float __attribute__((vector_size(16)));

  struct Node {
    std::array<Four, 3> min, max;
    // 1/m and 1/M; |m|, |M| ≥ kFlat.
    std::array<Four, 3> over_min, over_max;
    Four least_norm;
    // ≥ 0: node; otherwise ~triangle.  A child that is missing is far away.
    std::array<int, 4> child;
  };
  struct Entry {
    float squared_bound, least, most;
    int child;
  };
  using Place = std::array<float, 3>;

  // Each level of the tree leaves at most three siblings behind.
  static constexpr std::size_t kStack = 3 * BoxTree::kMaxDepth + 4;
  // Of floats: 2⁻²⁴ a rounding, some ten in a row; widening by kWide covers
  // those that are absolute, by kRelative those that are relative.
  static constexpr double kWide = 2e-6;
  static constexpr float kRelative = 4e-6F;
  static constexpr float kMostOffset = 4e3F;  // of any projection
  static constexpr float kFarAway = 1e6F, kNowhere = 1e30F;

  static Place PlaceOf(const Eigen::Vector3d& x) {
    return {static_cast<float>(x[0]), static_cast<float>(x[1]),
            static_cast<float>(x[2])};
  }
  static float SquaredLimit(double depth) {
    const float limit = static_cast<float>(std::min(depth, 1e3) + kWide);
    return limit * limit * (1.0F + 4.0F * kRelative);
  }
  static Offsets OffsetsOf(const Entry& entry) {
    return {static_cast<double>(entry.least * (1.0F - kRelative)),
            static_cast<double>(entry.most * (1.0F + kRelative)) + kWide};
  }

  // Puts the children of `node` that may hold a projection with squared bound
  // ≤ most on the stack, the least bound on top; → its new size.
  static std::size_t Push(const Node& node, const Place& x, float most,
                          Entry* stack, std::size_t size);

  struct Builder;

  std::vector<Node> nodes_;
};

inline std::size_t PrismTree::Push(const Node& node, const Place& x, float most,
                                   Entry* stack, std::size_t size) {
  const Four zero = {}, far = zero + kMostOffset;
  Four least = zero, last = far, squared = zero;
  for (std::size_t i = 0; i < 3; ++i) {
    const Four low = node.min[i] - x[i], high = node.max[i] - x[i];
    const Four beyond = low > -high ? low : -high;
    const Four away = beyond > zero ? beyond : zero;
    squared += away * away;
    // Where m > 0, t ≤ high/m; where m < 0, t ≥ high/m; M mirrored.
    const Four a = high * node.over_min[i], b = low * node.over_max[i];
    const Four a_most = node.over_min[i] > zero ? a : far;
    const Four a_least = node.over_min[i] > zero ? zero : a;
    const Four b_most = node.over_max[i] > zero ? far : b;
    const Four b_least = node.over_max[i] > zero ? b : zero;
    const Four most_here = a_most < b_most ? a_most : b_most;
    const Four least_here = a_least > b_least ? a_least : b_least;
    last = most_here < last ? most_here : last;
    least = least_here > least ? least_here : least;
  }
  const Four along = least * node.least_norm;
  const Four reached = along * along > squared ? along * along : squared;
  const Four bound =
      least <= last * (1.0F + 2.0F * kRelative) ? reached : zero + kNowhere;
  const std::size_t first = size;
  for (int c = 0; c < 4; ++c) {
    if (!(bound[c] <= most)) continue;
    const Entry entry{bound[c], least[c], last[c],
                      node.child[static_cast<std::size_t>(c)]};
    std::size_t at = size++;
    for (; at > first && stack[at - 1].squared_bound < entry.squared_bound;
         --at) {
      stack[at] = stack[at - 1];
    }
    stack[at] = entry;
  }
  return size;
}

}  // namespace phongpd
