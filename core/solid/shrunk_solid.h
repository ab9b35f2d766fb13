// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/solid/solid.h"

namespace phongpd {

// A solid and how far its surface was drawn in.
struct ShrunkSolid {
  Solid solid;         // the triangles of the original, its vertices moved
  double least = 0.0;  // every face lies at least so far below its plane, and
  double most = 0.0;   // no vertex moved farther; user's unit
};

// The solid with every face at least `by` > 0 (user's unit) below the plane it
// was in.  Each vertex v with the unit normals n_i of its faces moves the least
// way δ that does this,
//
//   δ = argmin { |δ| : n_i·δ ≤ −by for all i } = −by u / min_i n_i·u,
//
// u the centre of the smallest ball around the n_i: √3 by at a cube's corner.
// For parts that are drawn to fit exactly, which have no room to move.  It is
// no offset surface, and nothing is merged or split.
//
// Throws InputError naming the solid: `by` that is not positive and finite;
// a vertex whose faces have no common inside (min_i n_i·u < 0.05); walls or
// gaps too thin for it, so that what comes out is no solid.
ShrunkSolid Shrunk(const Solid& solid, double by);

}  // namespace phongpd
