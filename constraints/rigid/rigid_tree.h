// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// A box of the tree that rigid motions are judged with,
//
//   { center + axes y : |y_k| ≤ half_k },
//
// and the ball around its centre that holds what is in it.  To rounding: a few
// 2⁻⁵³ of the farthest corner, which the judge takes off its gaps.  The axes
// are those of space, or, where that box is smaller, those of what is in it: a
// patch of a surface is flat across its normal, whichever way that points.
struct RigidNode {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  // a rotation
  bool is_turned = false;                              // not the identity
  double radius = 0.0;
  int left = -1;      // the sibling follows; −1: a leaf,
  int triangle = -1;  // of this one

  bool IsLeaf() const { return left < 0; }
};

struct RigidTree {
  std::vector<RigidNode> nodes;          // none without triangles
  std::vector<TriangleCorners> corners;  // by the number of the triangle
  double reach = 0.0;                    // of the corner farthest from 0
  double size = 0.0;                     // half the diagonal of all
};

// Finite corners; a triangle may be a point or a segment.
RigidTree MakeRigidTree(std::vector<TriangleCorners> corners);

}  // namespace phongpd::internal
