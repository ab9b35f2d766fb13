// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace phongpd {

// A point of a segment and a point of a triangle.
struct SegmentTrianglePair {
  Eigen::Vector3d on_segment = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_triangle = Eigen::Vector3d::Zero();
  double squared_distance = 0.0;  // of the two
};

// The closest pair of the closed segment a b and the triangle p q r, slivers,
// points and degenerate triangles included; distance 0 where they meet.  Of
// several closest pairs any may be returned.
//
// A minimum of the distance is a crossing, an end of the segment against the
// triangle, a corner of the triangle against the segment, or an inner point of
// an edge against an inner point of the segment.  All are tried and compared
// by the distance actually reached, so the answer is never below the truth but
// for rounding (1e-15 of the coordinates).  Coordinates of about the size of
// one: squares must neither over- nor underflow.
SegmentTrianglePair ClosestPair(const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b,
                                const Eigen::Vector3d& p,
                                const Eigen::Vector3d& q,
                                const Eigen::Vector3d& r) noexcept;

}  // namespace phongpd
