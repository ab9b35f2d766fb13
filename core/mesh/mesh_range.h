// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The largest coordinate of a solid, and the range of its diagonal.  Squares
// and cubes of these lengths keep all their digits: contact spaces and queries
// are the same, bit for bit, under every power of two that stays in the range
// (tests/core/mesh/range_test.cc).
inline constexpr double kMaxCoordinate = 1e80;
inline constexpr double kMinDiagonal = 1e-80, kMaxDiagonal = 1e80;

// Throws InputError, naming `name`, the value and the limit, if a triangle has
// a finite corner beyond kMaxCoordinate.  MakeSolid asks for it.
void RequireInRange(const TriangleMesh& mesh, const std::string& name);

}  // namespace phongpd
