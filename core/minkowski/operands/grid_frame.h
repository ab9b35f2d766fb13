// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/operands/exact_grid.h"
#include "core/minkowski/operands/lattice.h"

namespace phongpd::internal {

// Both operands on one integer grid, each relative to a centre of its own, so
// that neither loses bits to an offset:
//   a ≈ α + Rᵀ step·i,   b ≈ β + Rᵀ step·j,   q = b − a ≈ ToUser(j − i).
struct GridFrame {
  // The operands' vertices, below 2^kGridBits; zero where no triangle uses
  // them.
  std::vector<GridPoint> robot, obstacle;
  double step = 1.0;  // user's unit
  // No coordinate was moved by more than this, user's unit; 0: the input lies
  // on the grid, nothing was rounded.
  double rounding = 0.0;
  // The grid is turned: rotation takes the user's axes to the grid's.
  bool is_turned = false;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();

  // The configuration of a difference x of grid points, in steps.  Where
  // nothing was rounded, lattice points come out as the nearest doubles: as
  // the decimals the user would write.
  Eigen::Vector3d ToUser(const Eigen::Vector3d& x) const;

  // Its inverse, in steps; rounded, but for configurations on the lattice.
  Eigen::Vector3d ToGrid(const Eigen::Vector3d& q) const;

  // q = origin + Rᵀ unit·(shift + stride·x).
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  LatticeUnit unit;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double stride = 1.0;
};

// What integers of one unit are divided by.
enum class LatticeDivisor {
  kGreatest,    // their greatest common divisor: the scale makes no difference
  kPowerOfTwo,  // the part of it that any configuration can be divided by
                // without rounding, unless the grid is too small for the rest
};

// The first of these that fits:
// 1. All coordinates are multiples of one unit 2^m·5^k (lattice.h): they
//    become integers without common factor, or without a common factor of two,
//    times a power of two.  Nothing is rounded, and neither scale nor place of
//    the operands makes a difference.
// 2. They are, measured from the operand's least corner, multiples of any
//    unit up to the rounding of the input.
// 3. The same in a turned frame (canonical_frame.h).
// 4. They are rounded to a binary grid of kGridBits bits for the larger
//    operand; in the turned frame those of one operand that differ by no more
//    than the input's rounding become one first.
// Requires solids: finite coordinates, no empty extent.
GridFrame PlaceOnGrid(const TriangleMesh& robot, const TriangleMesh& obstacle,
                      LatticeDivisor divisor = LatticeDivisor::kGreatest);

}  // namespace phongpd::internal
