// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/voxel_world.h"

#include <array>
#include <cmath>

#include "problems/shapes/random_solids.h"

namespace phongpd::testing {
namespace {

using Eigen::Vector3d;

struct Block {
  int n;
  std::vector<char> filled;
  int Index(int x, int y, int z) const { return (z * n + y) * n + x; }
};

// Filled if any of the cells is that a robot in this part of the lattice
// touches: one cell per axis for even numbers, two for odd ones.
bool Touches(const Block& block, const std::array<int, 3>& part) {
  for (int corner = 0; corner < 8; ++corner) {
    std::array<int, 3> cell;
    for (int k = 0; k < 3; ++k) {
      cell[k] = (part[k] + (corner >> k & 1)) / 2;
    }
    if (block.filled[block.Index(cell[0], cell[1], cell[2])]) return true;
  }
  return false;
}

}  // namespace

VoxelWorld MakeVoxelWorld(int n, double fill, double channel,
                          bool filled_around, std::mt19937_64* random) {
  const Voxels inner = RandomVoxels(n, fill, EdgeContact::kAllowed, random);
  Block block;
  block.n = n + 2;
  block.filled.assign(block.n * block.n * block.n, filled_around);
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        block.filled[block.Index(x + 1, y + 1, z + 1)] =
            inner.filled[(z * n + y) * n + x];
      }
    }
  }
  VoxelWorld world;
  // Part 2k: robot within cell k, of size δ; part 2k + 1: across the face to
  // cell k + 1, of size 1 − δ.
  Voxels parts;
  parts.n = 2 * block.n - 1;
  for (int z = 0; z < parts.n; ++z) {
    for (int y = 0; y < parts.n; ++y) {
      for (int x = 0; x < parts.n; ++x) {
        parts.filled.push_back(Touches(block, {x, y, z}));
      }
    }
  }
  world.contact_space = VoxelSurface(parts);
  for (Vector3d& v : world.contact_space.vertices) {
    for (int k = 0; k < 3; ++k) {
      const int line = static_cast<int>(v[k]);
      v[k] = line / 2 +
             (line % 2 == 0 ? 0.5 - 0.5 * channel : 0.5 + 0.5 * channel);
    }
  }
  // Flood fill.
  std::vector<int> label(block.filled.size(), -1);
  int count = 0;
  for (std::size_t seed = 0; seed < label.size(); ++seed) {
    if (block.filled[seed] || label[seed] >= 0) continue;
    std::vector<int> open = {static_cast<int>(seed)};
    label[seed] = count;
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      const std::array<int, 3> at = {cell % block.n, cell / block.n % block.n,
                                     cell / (block.n * block.n)};
      world.centers.emplace_back(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5);
      world.labels.push_back(count);
      for (int k = 0; k < 3; ++k) {
        for (const int step : {-1, 1}) {
          std::array<int, 3> next = at;
          next[k] += step;
          if (next[k] < 0 || next[k] >= block.n) continue;
          const int other = block.Index(next[0], next[1], next[2]);
          if (block.filled[other] || label[other] >= 0) continue;
          label[other] = count;
          open.push_back(other);
        }
      }
    }
    ++count;
  }
  return world;
}

}  // namespace phongpd::testing
