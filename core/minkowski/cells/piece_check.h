// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/minkowski/cells/surface_piece.h"

namespace phongpd::internal {

// A piece from a file need not be one that WindowCells wrote.  What of it is
// none, as "expected …, found …"; empty if joining can rely on it: numbers in
// the ranges of exact_grid.h, planes distinct and those of faces coprime,
// points distinct and exactly in the planes of all faces that have them,
// borders that close, are nowhere of length zero and have the face on their
// left, walls where edges say so, and each edge that is in none with a face
// on both sides.
//
// That is all one box can tell: whether boxes fit each other, and borders cross
// nowhere, is found when they are joined (SurfaceError).
std::string PieceDefect(const SurfacePiece& piece);

}  // namespace phongpd::internal
