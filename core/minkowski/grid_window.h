// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/minkowski/convolution.h"

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
};

// The convolution in half steps, and behind it the window's walls: 12 facets,
// each pair of a source of its own, that look into the window.
Convolution WithWalls(const Convolution& part, const GridWindow& window);

}  // namespace phongpd::internal
