// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/minkowski/convolution/convolution.h"

namespace phongpd::internal {

// A box in q-space in half grid steps, all its coordinates odd: no grid point
// and no facet along an axis lies in a wall.
struct GridWindow {
  GridPoint min, max;

  // The box of half-width `reach` ≥ 1 around q (grid steps), rounded outwards.
  static GridWindow Around(const Eigen::Vector3d& q, double reach);
  // In grid steps.
  BoundingBox Box() const;
  // Of a point in it to the nearest wall, grid steps; ≤ 0 outside.
  double WallDistance(const Eigen::Vector3d& q) const;
  // Low and high half across the longest side; none where that is too narrow.
  std::optional<std::array<GridWindow, 2>> Halves() const;
};

// A rectangle of a wall, half steps.
struct WallPatch {
  int axis = 0;          // across which the wall lies
  bool is_high = false;  // the window's wall at max[axis]
  GridPoint min{}, max{};
  int beyond = -1;  // what is there: a number of the caller's
};

// The six walls, a patch each.
std::vector<WallPatch> WholeWalls(const GridWindow& window);

// The convolution in half steps, and behind it the walls that `patches` make
// up: two facets a patch, each pair of a source of its own, that look into the
// window.
Convolution WithWalls(const Convolution& part,
                      const std::vector<WallPatch>& patches);

}  // namespace phongpd::internal
