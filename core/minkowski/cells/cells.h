// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <vector>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/radial_edges.h"
#include "core/minkowski/operands/solid_collision.h"

namespace phongpd::internal {

// Faces are not the whole boundary of a region.  Of operands it is a defect of
// the library; of pieces from files it is the files'.
struct SurfaceError : std::logic_error {
  using std::logic_error::logic_error;
};

// The unbounded cell is occupied: the arrangement leaks.
struct LeakError : SurfaceError {
  using SurfaceError::SurfaceError;
};

// Which sides of the arrangement look into free space.
struct FreeCells {
  std::vector<char> side_is_free;   // per side, see PlusSide
  std::vector<char> side_is_outer;  // and belongs to the unbounded cell
  int cells = 0;                    // of the arrangement
  int cavities = 0;                 // bounded free cells
  int judged = 0;                   // collision tests that were needed
};

// Joins the sides that face each other around every edge into cells.  Behind
// (−) any convolution facet the operands overlap, so only cells made of +
// sides alone can be free; each of them is judged by one collision test at a
// point well inside it.  The unbounded cell is free by definition.  Free
// cells that belong to edge-disjoint parts of the arrangement but to one
// region of space count as one cell.
// Throws LeakError when it is not, InputError
// when `limits` are passed.
FreeCells FindFreeCells(const Convolution& convolution,
                        const Arrangement& arrangement,
                        const RadialEdges& radial, const ExactPoints& points,
                        const SolidCollision& judge, const BuildLimits& limits);

// The same for the faces between free and occupied space alone: every cell of
// + sides is free.
FreeCells FindCellsOfSurface(const Convolution& convolution,
                             const Arrangement& arrangement,
                             const RadialEdges& radial,
                             const ExactPoints& points);

}  // namespace phongpd::internal
