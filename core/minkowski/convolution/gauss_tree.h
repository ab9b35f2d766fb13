// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/bvh/box_tree.h"

namespace phongpd::internal {

// Unit vectors u with |u − center| ≤ radius; all of them for radius 2.
struct GaussCap {
  Eigen::Vector3d center = Eigen::Vector3d::UnitZ();
  double radius = 2.0;
};

// A cap that holds every normalised Σ wᵢ nᵢ, wᵢ ≥ 0, of unit vectors nᵢ, with
// room for their rounding: a cap of less than 85° around their mean, or the
// whole sphere where that does not hold them.
GaussCap CapAround(const Eigen::Vector3d* normals, std::size_t count);

// Caps on the sphere of unit normals, found by what they overlap.  On a smooth
// solid of n facets the normals at a vertex, or along the arc of an edge, lie
// in a cap of radius n^−½: a query finds a handful of them.
class GaussTree {
 public:
  explicit GaussTree(std::vector<GaussCap> caps);

  // visit(index) for every cap that overlaps `cap`, in no stated order.
  template <typename Visit>
  void ForEachNear(const GaussCap& cap, const Visit& visit) const {
    const Eigen::Vector3d low = cap.center.array() - cap.radius;
    const Eigen::Vector3d high = cap.center.array() + cap.radius;
    tree_.ForEach(
        [&](int index) {
          const BoxTree::Node& node = tree_.nodes()[index];
          return (node.min.array() <= high.array()).all() &&
                 (node.max.array() >= low.array()).all();
        },
        [&](int position) {
          const int item = tree_.order()[position];
          const double reach = caps_[item].radius + cap.radius;
          if ((caps_[item].center - cap.center).squaredNorm() <=
              reach * reach) {
            visit(item);
          }
          return true;
        });
  }

 private:
  std::vector<GaussCap> caps_;
  BoxTree tree_;
};

}  // namespace phongpd::internal
