// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/rigid/rigid_tree.h"

#include <algorithm>
#include <utility>

#include "core/bvh/box_tree.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// The positions of a node's items in the order of the tree.
struct ItemRange {
  int first = 0, last = 0;
};

}  // namespace

RigidTree MakeRigidTree(std::vector<TriangleCorners> corners) {
  RigidTree tree;
  std::vector<BoundingBox> boxes;
  boxes.reserve(corners.size());
  for (const TriangleCorners& t : corners) {
    boxes.push_back({t[0].cwiseMin(t[1]).cwiseMin(t[2]),
                     t[0].cwiseMax(t[1]).cwiseMax(t[2])});
    for (const Vector3d& x : t) tree.reach = std::max(tree.reach, x.norm());
  }
  const BoxTree boxed(boxes, 1);
  const auto& nodes = boxed.nodes();
  tree.nodes.resize(nodes.size());
  std::vector<ItemRange> items(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {  // children first
    const BoxTree::Node& from = nodes[i];
    RigidNode& node = tree.nodes[i];
    node.center = 0.5 * (from.min + from.max);
    node.half = (from.max - node.center).cwiseMax(node.center - from.min);
    const auto first = static_cast<std::size_t>(from.first);
    if (from.IsLeaf()) {
      node.triangle = boxed.order()[first];
      items[i] = {from.first, from.first + 1};
    } else {
      node.left = from.first;
      items[i] = {std::min(items[first].first, items[first + 1].first),
                  std::max(items[first].last, items[first + 1].last)};
    }
    double squared = 0.0;
    for (int k = items[i].first; k < items[i].last; ++k) {
      const int item = boxed.order()[static_cast<std::size_t>(k)];
      for (const Vector3d& x : corners[static_cast<std::size_t>(item)]) {
        squared = std::max(squared, (x - node.center).squaredNorm());
      }
    }
    node.radius = std::sqrt(squared);
  }
  if (!tree.nodes.empty()) tree.size = tree.nodes[0].half.norm();
  tree.corners = std::move(corners);
  return tree;
}

}  // namespace phongpd::internal
