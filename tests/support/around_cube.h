// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/free_space.h"
#include "tests/support/solid_tools.h"

namespace phongpd::testing {

// Contact space of a cube of side 0.5 against one of side 1.5: half-width 1.
inline FreeSpace AroundCube(const BoundingBox& bounds = FreeSpace::NoBounds()) {
  return FreeSpace({BuildContactSpace(Cube(0.5), Cube(1.5))}, bounds);
}

}  // namespace phongpd::testing
