// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace phongpd {

class TriangleBvh;

// A path with the same ends as others and what it may give away.
struct RoutedPath {
  std::vector<Eigen::Vector3d> points;  // two or more; free
  double clearance = 0.0;               // new segments keep it, ≥ 0
};

// The shortest path through points of several paths with the same ends, by
// their own segments and by straight ones that see each other: the visibility
// graph of all their corners.  It takes the best way around each obstacle from
// whichever path has it (hybridisation graphs, Raveh, Enosh and Halperin 2011,
// with an exact test for the bridges).
//
// A new segment from a point of one path to a point of another keeps the
// lesser of both clearances, by an exact test that it is free.  Empty without
// paths.  Deterministic; a segment is tested only when the search needs it.
std::vector<Eigen::Vector3d> RecombinePaths(
    const std::vector<RoutedPath>& paths, const TriangleBvh& segments);

// Are two paths of at least two points the same but for details?  Points at
// equal shares of their lengths are within `tolerance` times the first one's
// length of each other; sampled, so only a good guess.
bool TakeSameWay(const std::vector<Eigen::Vector3d>& one,
                 const std::vector<Eigen::Vector3d>& other, double tolerance);

}  // namespace phongpd
