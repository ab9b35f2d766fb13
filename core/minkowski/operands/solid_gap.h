// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// How far two solids that do not meet are apart: a branch and bound over two
// trees of facets, rounded to 1e-15 of the coordinates.
class SolidGap {
 public:
  // P = B and Q = −A; keeps references.
  SolidGap(const GridSolid& p, const GridSolid& q);

  struct Nearest {
    double distance = 0.0;  // grid steps
    // A point of each surface with |on_p + on_q − x| = distance.
    Eigen::Vector3d on_p = Eigen::Vector3d::Zero();
    Eigen::Vector3d on_q = Eigen::Vector3d::Zero();
    int facet_of_p = -1, facet_of_q = -1;
  };
  // Of B and A + x, x in grid steps.
  Nearest Find(const Eigen::Vector3d& x) const;

 private:
  const GridSolid& p_;
  const GridSolid& q_;
  BoxTree p_tree_, q_tree_;
};

}  // namespace phongpd::internal
