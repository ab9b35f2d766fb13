// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <random>

#include "planners/world/world.h"

namespace phongpd::bench {

// Start and goal of a problem.
struct Ends {
  Eigen::Vector3d start, goal;
};

// Free, and farther from C_cont than 0.02 D, which is room for the default
// margin; drawn in the box of C_cont widened by a tenth.  The line between them
// collides.  Builds free space alone.
Ends RandomEnds(const World& world, std::mt19937_64* random);

}  // namespace phongpd::bench
