// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "core/bvh/box_tree.h"

namespace phongpd {

// Of two nodes of which one at least is no leaf: is the first to be split?
// The larger one is, which keeps their sizes alike.
inline bool SplitsFirst(const BoxTree::Node& a, const BoxTree::Node& b) {
  return b.IsLeaf() || (!a.IsLeaf() && (a.max - a.min).squaredNorm() >=
                                           (b.max - b.min).squaredNorm());
}

// Visits the pairs of items of two trees all of whose ancestors pass
// keep(node index of a, node index of b) → bool.  visit(position in a.order(),
// position in b.order()) → bool; false stops.  Does not allocate.
template <typename Keep, typename Visit>
void ForEachPair(const BoxTree& a, const BoxTree& b, const Keep& keep,
                 const Visit& visit) {
  if (a.nodes().empty() || b.nodes().empty()) return;
  // Each step replaces a pair by two, one level lower in one of the trees.
  std::pair<int, int> stack[2 * BoxTree::kMaxDepth + 2];
  int size = 0;
  const auto push = [&](int i, int j) {
    if (keep(i, j)) stack[size++] = {i, j};
  };
  for (push(0, 0); size > 0;) {
    const auto [i, j] = stack[--size];
    const BoxTree::Node& first = a.nodes()[i];
    const BoxTree::Node& second = b.nodes()[j];
    if (first.IsLeaf() && second.IsLeaf()) {
      for (int k = first.first; k < first.first + first.count; ++k) {
        for (int l = second.first; l < second.first + second.count; ++l) {
          if (!visit(k, l)) return;
        }
      }
      continue;
    }
    const bool splits_first = SplitsFirst(first, second);
    for (int k = 0; k < 2; ++k) {
      push(splits_first ? first.first + k : i,
           splits_first ? j : second.first + k);
    }
  }
}

}  // namespace phongpd
