// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/mesh/box_tree.h"

namespace phongpd::internal {

// Wanted edge length h(x) = min(L, g·L + ½ d(x)), d(x) the distance to the
// nearest sharp edge: g·L at sharp edges, L from 2 (1 − g) L away from them.
// Its slope of ½ is what Delaunay refinement can follow without slivers.
class EdgeLengthField {
 public:
  using Segment = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

  // L = `longest` > 0, g = `fraction` in (0, 1].
  EdgeLengthField(const std::vector<Segment>& sharp_edges, double longest,
                  double fraction);

  double operator()(const Eigen::Vector3d& x) const;
  // The least and largest value there can be.
  double Least() const { return least_; }
  double Largest() const { return largest_; }

 private:
  double largest_;
  double least_;
  std::vector<Segment> segments_;  // in the tree's order
  BoxTree tree_;
};

}  // namespace phongpd::internal
