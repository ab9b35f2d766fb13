// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace phongpd {

// A perfect maze on the n × n × n lattice of [−0.75, 0.75]³: a corridor joins
// every node but the first to its parent.  Node numbers run along x fastest.
struct Maze {
  int n = 0;
  std::vector<int> parent;  // of each node; node 0 is its own

  Eigen::Vector3d Place(int node) const;
};

// A random spanning tree, depth first; n ≥ 2.  Same seed, same maze on every
// platform.
Maze RandomMaze(int n, std::uint64_t seed);

}  // namespace phongpd
