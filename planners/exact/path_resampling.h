// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace phongpd {

// A polyline as waypoints + 2 points: every corner is one of them, the others
// divide the segments between corners evenly so that the longest of all pieces
// is as short as possible: at most L/(waypoints + 2 − segments).  Empty if
// there are more inner corners than waypoints, or fewer than 2 points; throws
// InputError for a point that is not finite, and for a segment of more than
// 1e154, whose square no double holds.  New points are rounded, so a path that
// is closer to something than 1e-15 of its coordinates must be judged again.
std::vector<Eigen::Vector3d> ResampleKeepingCorners(
    const std::vector<Eigen::Vector3d>& corners, int waypoints);

}  // namespace phongpd
