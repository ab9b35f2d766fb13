// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bvh/box_tree.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace phongpd {

namespace {

using Eigen::Vector3d;

constexpr int kBins = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

BoundingBox EmptyBox() {
  return {Vector3d::Constant(kInfinity), Vector3d::Constant(-kInfinity)};
}

void Extend(const BoundingBox& other, BoundingBox* box) {
  box->min = box->min.cwiseMin(other.min);
  box->max = box->max.cwiseMax(other.max);
}

double HalfArea(const BoundingBox& box) {
  if (box.IsEmpty()) return 0.0;
  const Vector3d d = box.max - box.min;
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

// An item where it is sorted, with what that takes.
struct SortedItem {
  BoundingBox box;
  Vector3d middle;
  int number;
};

struct Range {
  int node;
  int first;
  int last;  // one past the end
  int depth;
};

// Splits items[first, last) and returns the first position of the right part.
class Splitter {
 public:
  using Iterator = std::vector<SortedItem>::iterator;

  static int Split(const Range& range, std::vector<SortedItem>* items) {
    const Iterator begin = items->begin() + range.first;
    const Iterator end = items->begin() + range.last;
    Vector3d low = Vector3d::Constant(kInfinity);
    Vector3d high = Vector3d::Constant(-kInfinity);
    for (Iterator it = begin; it != end; ++it) {
      low = low.cwiseMin(it->middle);
      high = high.cwiseMax(it->middle);
    }
    int axis = 0;
    const double extent = (high - low).maxCoeff(&axis);
    if (range.depth < BoxTree::kSplitDepth && extent > 0.0) {
      const int bin = BestBin(begin, end, low[axis], extent, axis);
      const Iterator middle =
          std::partition(begin, end, [&](const SortedItem& item) {
            return BinOf(item, low[axis], extent, axis) <= bin;
          });
      if (middle != begin && middle != end) {
        return static_cast<int>(middle - items->begin());
      }
    }
    const Iterator middle = begin + (range.last - range.first) / 2;
    std::nth_element(begin, middle, end,
                     [axis](const SortedItem& a, const SortedItem& b) {
                       return a.middle[axis] < b.middle[axis];
                     });
    return static_cast<int>(middle - items->begin());
  }

 private:
  static int BinOf(const SortedItem& item, double low, double extent,
                   int axis) {
    const double position = (item.middle[axis] - low) / extent * kBins;
    return std::clamp(static_cast<int>(position), 0, kBins - 1);
  }

  // The bin after which a cut is cheapest by surface area.
  static int BestBin(Iterator begin, Iterator end, double low, double extent,
                     int axis) {
    std::array<BoundingBox, kBins> box;
    std::array<int, kBins> count{};
    box.fill(EmptyBox());
    for (Iterator it = begin; it != end; ++it) {
      const int bin = BinOf(*it, low, extent, axis);
      Extend(it->box, &box[bin]);
      ++count[bin];
    }
    std::array<double, kBins> right_cost{};
    BoundingBox sum = EmptyBox();
    int items = 0;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      Extend(box[i], &sum);
      items += count[i];
      right_cost[i - 1] = HalfArea(sum) * items;
    }
    sum = EmptyBox();
    items = 0;
    double best = kInfinity;
    int best_bin = 0;
    for (std::size_t i = 0; i + 1 < kBins; ++i) {
      Extend(box[i], &sum);
      items += count[i];
      const double cost = HalfArea(sum) * items + right_cost[i];
      if (cost < best) {
        best = cost;
        best_bin = static_cast<int>(i);
      }
    }
    return best_bin;
  }
};

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
  std::vector<SortedItem> items;
  items.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    items.push_back({boxes[i], boxes[i].Center(), static_cast<int>(i)});
  }
  nodes_.emplace_back();
  std::vector<Range> open{{0, 0, static_cast<int>(boxes.size()), 0}};
  while (!open.empty()) {
    const Range range = open.back();
    open.pop_back();
    BoundingBox box = EmptyBox();
    for (int i = range.first; i < range.last; ++i) {
      Extend(items[i].box, &box);
    }
    Node node;
    node.min = box.min;
    node.max = box.max;
    if (range.last - range.first <= leaf_size) {
      node.first = range.first;
      node.count = range.last - range.first;
    } else {
      const int middle = Splitter::Split(range, &items);
      node.first = static_cast<int>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
      open.push_back({node.first, range.first, middle, range.depth + 1});
      open.push_back({node.first + 1, middle, range.last, range.depth + 1});
    }
    nodes_[range.node] = node;
  }
  order_.reserve(items.size());
  for (const SortedItem& item : items) order_.push_back(item.number);
  assert(IsSound(nodes_, order_, boxes));
}

}  // namespace phongpd
