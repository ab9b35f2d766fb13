// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// From a point of triangle b to one of triangle a, the closest two to rounding
// where the triangles are apart: of two edges, or of a corner and a face. Where
// an edge runs through a face it is the shortest of those.
struct ClosestOffset {
  // Its length is a distance of two points, whatever rounding does.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  // The same way, 1 long to 4 u or 0, by what is closest: the normal of a face,
  // or what is across an edge or two.  Close to contact it parts triangles
  // better than the offset, of which rounding leaves little.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_first = Eigen::Vector3d::Zero();  // the point of a
};

ClosestOffset FindClosestOffset(const TriangleCorners& a,
                                const TriangleCorners& b);

}  // namespace phongpd::internal
