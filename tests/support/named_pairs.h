// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::testing {

struct NamedPair {
  const char* name;
  TriangleMesh robot, obstacle;
};

// Small pairs of every kind: convex and not, a hole, a cavity, an exact fit, a
// general position.
inline std::vector<NamedPair> SmallPairs() {
  return {
      {"ball and cone", MakeIcoBall(0.5, 1), MakeCone(0.8, 1.6, 12)},
      {"star and torus", MakeStar(0.5, 1.2), MakeTorus(2, 0.6, 12, 6)},
      {"cube and hollow shell", Cube(1), MakeVessel(4, 3, 0)},
      {"L and U", MakeL(1, 0.3, 0.5), MakeU(2, 0.5, 1)},
      // Touching without an inside: only one position fits.
      {"peg and its hole", MakeBox({-0.5, -0.5, -1}, {0.5, 0.5, 1}),
       MakePlateWithHole(4, 1, 1)},
      {"star and turned vessel", MakeStar(0.3, 0.7),
       Rotated(MakeVessel(3.6, 3, 0.6), GenericRotation())},
  };
}

}  // namespace phongpd::testing
