// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/box_tree.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/mesh/numbers.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

constexpr int kBins = 16;
using internal::kInfinity;

// A box as its upper and its negated lower bounds, so that one maximum extends
// it: building the tree does little else.
using Extent = Eigen::Array<double, 6, 1>;

Extent NoExtent() { return Extent::Constant(-kInfinity); }

void Extend(const Extent& other, Extent* extent) {
  *extent = extent->max(other);
}

Extent ExtentOf(const Vector3d& min, const Vector3d& max) {
  Extent extent;
  extent << max.array(), -min.array();
  return extent;
}

double HalfArea(const Extent& e) {
  const Vector3d d = e.head<3>() + e.tail<3>();
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

struct Item {
  Extent box;
  int number;
  int bin;  // of the range that is being split

  double Middle(int axis) const { return 0.5 * (box[axis] - box[axis + 3]); }
};

// What a node is made of.
struct Range {
  int node;
  int first;
  int last;  // one past the end
  int depth;
  Extent box;  // of the items
};

using Iterator = std::vector<Item>::iterator;

Extent BoxOf(Iterator begin, Iterator end) {
  Extent box = NoExtent();
  for (Iterator it = begin; it != end; ++it) Extend(it->box, &box);
  return box;
}

// Of the boxes' centres.
Extent MiddlesOf(Iterator begin, Iterator end) {
  Extent extent = NoExtent();  // twice as far from the origin
  for (Iterator it = begin; it != end; ++it) {
    const Eigen::Array3d twice = it->box.head<3>() - it->box.tail<3>();
    Extent middle;
    middle << twice, -twice;
    Extend(middle, &extent);
  }
  return 0.5 * extent;
}

// The items of a range sorted into bins along one axis.  The first and the last
// bin are never empty.
class Bins {
 public:
  // Sorts them.
  Bins(Iterator begin, Iterator end, double low, double extent, int axis) {
    for (Iterator it = begin; it != end; ++it) {
      const double position = (it->Middle(axis) - low) / extent * kBins;
      it->bin = std::clamp(static_cast<int>(position), 0, kBins - 1);
      if (count_[it->bin]++ == 0) {
        box_[it->bin] = it->box;
      } else {
        Extend(it->box, &box_[it->bin]);
      }
    }
  }

  // The bin after which a cut is cheapest by surface area; the boxes of what is
  // before and behind the cut.
  int BestCut(Extent* left, Extent* right) const {
    std::array<Extent, kBins> behind;
    std::array<double, kBins> cost_behind;
    Extent sum = NoExtent();
    int items = 0;
    for (int i = kBins - 1; i > 0; --i) {
      if (count_[i] > 0) {
        Extend(box_[i], &sum);
        items += count_[i];
      }
      if (count_[i - 1] == 0) continue;
      behind[i - 1] = sum;
      cost_behind[i - 1] = HalfArea(sum) * items;
    }
    sum = NoExtent();
    items = 0;
    double best = kInfinity;
    int best_bin = 0;
    for (int i = 0; i + 1 < kBins; ++i) {
      // Behind an empty bin the cut is the one before it.
      if (count_[i] == 0) continue;
      Extend(box_[i], &sum);
      items += count_[i];
      const double cost = HalfArea(sum) * items + cost_behind[i];
      if (cost < best || i == 0) {
        best = cost;
        best_bin = i;
        *left = sum;
        *right = behind[i];
      }
    }
    return best_bin;
  }

 private:
  std::array<Extent, kBins> box_;  // where there is something
  std::array<int, kBins> count_{};
};

// Sorts the items of a range into those of the nodes `child` and child + 1.
void Split(const Range& range, int child, std::vector<Item>* items, Range* left,
           Range* right) {
  const Iterator begin = items->begin() + range.first;
  const Iterator end = items->begin() + range.last;
  *left = {child, range.first, range.last, range.depth + 1, NoExtent()};
  *right = {child + 1, range.first, range.last, range.depth + 1, NoExtent()};
  const Extent middles = MiddlesOf(begin, end);
  int axis = 0;
  const double extent = (middles.head<3>() + middles.tail<3>()).maxCoeff(&axis);
  Iterator middle;
  if (range.depth < BoxTree::kSplitDepth && extent > 0.0) {
    const Bins bins(begin, end, -middles[axis + 3], extent, axis);
    const int cut = bins.BestCut(&left->box, &right->box);
    middle = std::partition(
        begin, end, [cut](const Item& item) { return item.bin <= cut; });
  } else {
    middle = begin + (range.last - range.first) / 2;
    std::nth_element(begin, middle, end, [axis](const Item& a, const Item& b) {
      return a.Middle(axis) < b.Middle(axis);
    });
    left->box = BoxOf(begin, middle);
    right->box = BoxOf(middle, end);
  }
  left->last = right->first = static_cast<int>(middle - items->begin());
}

// What both traversals rely on: children come in pairs behind their parent and
// lie within it, no path overflows the traversals' stack, and every item is in
// one leaf, within its box.
[[maybe_unused]] bool IsSound(const std::vector<BoxTree::Node>& nodes,
                              const std::vector<int>& order,
                              const std::vector<BoundingBox>& boxes) {
  const auto holds = [](const BoxTree::Node& node, const Vector3d& min,
                        const Vector3d& max) {
    return (node.min.array() <= min.array()).all() &&
           (node.max.array() >= max.array()).all();
  };
  std::vector<int> depth(nodes.size(), 0);
  std::vector<char> seen(boxes.size(), 0);
  std::size_t reached = 1;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const BoxTree::Node& node = nodes[n];
    for (int i = node.first; i < node.first + node.count; ++i) {
      const BoundingBox& box = boxes[order[i]];
      if (seen[order[i]]++ != 0 || !holds(node, box.min, box.max)) return false;
    }
    if (node.IsLeaf()) continue;
    for (const int child : {node.first, node.first + 1}) {
      if (child <= static_cast<int>(n) ||
          child >= static_cast<int>(nodes.size()) ||
          !holds(node, nodes[child].min, nodes[child].max)) {
        return false;
      }
      depth[child] = depth[n] + 1;
      if (depth[child] >= BoxTree::kMaxDepth) return false;
      ++reached;
    }
  }
  return reached == nodes.size() &&
         std::count(seen.begin(), seen.end(), 1) ==
             static_cast<std::ptrdiff_t>(boxes.size());
}

}  // namespace

BoxTree::BoxTree(const std::vector<BoundingBox>& boxes, int leaf_size) {
  if (boxes.empty()) return;
  std::vector<Item> items;
  items.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    items.push_back(
        {ExtentOf(boxes[i].min, boxes[i].max), static_cast<int>(i), 0});
  }
  nodes_.emplace_back();
  std::vector<Range> open{{0, 0, static_cast<int>(boxes.size()), 0,
                           BoxOf(items.begin(), items.end())}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    Node node;
    node.min = -range.box.tail<3>();
    node.max = range.box.head<3>();
    if (range.last - range.first <= leaf_size) {
      node.first = range.first;
      node.count = range.last - range.first;
    } else {
      node.first = static_cast<int>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
      open.resize(open.size() + 2);
      Split(range, node.first, &items, &open[open.size() - 2], &open.back());
    }
    nodes_[range.node] = node;
  }
  order_.reserve(items.size());
  for (const Item& item : items) order_.push_back(item.number);
  assert(IsSound(nodes_, order_, boxes));
}

}  // namespace phongpd
