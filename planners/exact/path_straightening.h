// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "planners/exact/free_space.h"

// Polylines through free space: shorter, and cut into waypoints.
namespace phongpd {

struct StraighteningOptions {
  // A short cut keeps this distance from everything, or what the part it
  // replaces had; user's unit, ≥ 0.
  double clearance = 0.0;
  int random_cuts = 120;
};

struct StraightenedPath {
  std::vector<Eigen::Vector3d> points;  // corners and the two ends
  int tried = 0;                        // short cuts
  int taken = 0;
};

// Replaces parts of an exactly free path by exactly free segments that keep
// the clearance: first from each corner as far as it sees, then between random
// points of the path.  Never longer than the path, same ends, and free.
StraightenedPath Straighten(const FreeSpace& space,
                            std::vector<Eigen::Vector3d> path,
                            const StraighteningOptions& options,
                            std::mt19937_64* random);

// The polyline as waypoints + 2 points: every corner is one of them, the others
// divide the segments between corners evenly so that the longest of all
// pieces is as short as possible.  Empty if there are more inner corners than
// waypoints, or fewer than 2 points.  New points are rounded, so a polyline
// closer to an obstacle than 1e-16 of its coordinates must be judged again.
std::vector<Eigen::Vector3d> ResampleKeepingCorners(
    const std::vector<Eigen::Vector3d>& corners, int waypoints);

}  // namespace phongpd
