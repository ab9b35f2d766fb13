// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "core/solid/solid.h"
#include "tests/support/lattice_world.h"

namespace phongpd::testing {

// A robot and an obstacle made of cubes, mapped, and what is known of their
// free space without any planner (lattice_world.h).
struct VoxelPair {
  enum class Kind {
    kAxis,     // as they are
    kThin,     // one or two axes are up to a thousandth as long
    kSheared,  // by an integer matrix
    kScaled,   // that too, and by an odd number: no power of two divides all
    kDecimal,  // tenths or thousandths, as doubles come nearest to them
    kMerged,   // as any of these, of components that overlap and touch
  };
  static constexpr int kKinds = 6;
  using Quarters = std::array<int, 3>;  // four times the coordinates

  std::string name;
  Solid robot, obstacle;  // mapped
  LatticeWorld cells;     // without contact space; workspace: before the map
  int divisor = 1;        // of all coordinates, after the map
  std::vector<std::vector<LatticeWorld::Cell>> parts;  // by label

  // A point of any connected part of free space, or one of 8 anywhere: on the
  // lattice of halves, and of quarters where that is in the same cell.
  Quarters RandomPoint(std::mt19937_64* random) const;
  // Of a free point the number of its connected part; −1: not free.
  int Label(const Quarters& point) const;
  Eigen::Vector3d Point(const Quarters& point) const;  // mapped
};

VoxelPair MakeVoxelPair(VoxelPair::Kind kind, std::mt19937_64* random);

}  // namespace phongpd::testing
