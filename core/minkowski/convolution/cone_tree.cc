// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/cone_tree.h"

namespace phongpd::internal {

ConeTree::ConeTree(const std::vector<BoundingBox>& boxes,
                   const std::vector<GaussCap>& caps)
    : tree_(boxes, 4) {
  boxes_.reserve(boxes.size());
  caps_.reserve(caps.size());
  for (const int item : tree_.order()) {
    boxes_.push_back(boxes[item]);
    caps_.push_back(caps[item]);
  }
  const std::vector<BoxTree::Node>& nodes = tree_.nodes();
  normals_.resize(nodes.size());
  const auto widen = [](const BoundingBox& other, BoundingBox* box) {
    box->min = box->min.cwiseMin(other.min);
    box->max = box->max.cwiseMax(other.max);
  };
  // Children come after their parent.
  for (std::size_t i = nodes.size(); i-- > 0;) {
    const BoxTree::Node& node = nodes[i];
    BoundingBox& box = normals_[i];
    if (!node.IsLeaf()) {
      box = normals_[node.first];
      widen(normals_[node.first + 1], &box);
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k) {
      const GaussCap& cap = caps_[k];
      const BoundingBox own = {cap.center.array() - cap.radius,
                               cap.center.array() + cap.radius};
      if (k == node.first) box = own;
      widen(own, &box);
    }
  }
}

}  // namespace phongpd::internal
