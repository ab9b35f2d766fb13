// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/bvh/box_tree.h"
#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// Conservative tests of a segment against boxes.
class SegmentReach {
 public:
  // `largest`: of all absolute coordinates of the boxes.
  SegmentReach(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
               double largest);

  // Does the segment meet the box, widened by `margin`?
  bool Meets(const BoxTree::Node& node, double margin = 0.0) const;
  // Lower bound of the distance to a box.
  double Gap(const BoxTree::Node& node) const;
  // Lower bound of the fraction at which the segment enters a box it meets.
  double Entry(const BoxTree::Node& node) const;

 private:
  Eigen::Vector3d a_, min_, max_, half_, direction_, slack_;
};

// Does the triangle's plane alone keep the segment further away than
// `distance`?  Of most triangles near a segment it does.
bool IsBeyond(const TriangleCorners& t, const Eigen::Vector3d& a,
              const Eigen::Vector3d& b, double distance);

// Distance of the segment to the triangle, were it not to pass through:
// unlike ClosestPair it knows no crossings, and needs no points.
double OutlineDistance(const TriangleCorners& t, const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b);

}  // namespace phongpd::internal
