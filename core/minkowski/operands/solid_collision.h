// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// Exact collision test of the two operands on the grid: does A + q meet B?
// The one judgement a cell of the arrangement needs.  Winding numbers of the
// *convolution* cannot replace it (they are the Euler characteristic of the
// intersection and may be 0 inside).
class SolidCollision {
 public:
  // `obstacle` is B; `reflected_robot` is −A as the convolution uses it.
  SolidCollision(const GridSolid& obstacle, const GridSolid& reflected_robot);
  ~SolidCollision();

  // q in grid steps relative to the frame's origin, |q| < 2^40.  Decided
  // exactly for RoundedToFractions(q).
  bool Collide(const Eigen::Vector3d& q) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::internal
