// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Random pairs of solids that are hard for a contact-space builder: exactly
// or nearly coplanar, touching, tight.
namespace phongpd {

enum class PairKind {
  kAligned,      // voxel solids, axis-aligned
  kTurnedAlike,  // the same, both turned by one rotation
  kTurnedApart,  // and by two
  kTilted,       // turned alike, then the robot by another 1e-12 to 1e-8 rad
  kJittered,     // turned alike, then each vertex moved by 1e-12 to 1e-8
  kPeg,          // square or round peg in its hole, clearance 0, 1e-3 ... 1e-9
  kEdgeTouch,    // two boxes whose sums with the robot touch along an edge
  kVertexTouch,  // ... in a vertex
  kCavity,       // robot in a closed hollow box
  kManyBoxes,    // a voxel world of up to 100 boxes in a hollow box
};

// All of them, and the name of each for people.
const std::vector<PairKind>& AllPairKinds();
std::string Name(PairKind kind);

struct SolidPair {
  TriangleMesh robot;
  TriangleMesh obstacle;
  // What the contact space must have, where another route tells: by counting
  // lattice cells, or in closed form.  Volumes of turned pairs hold up to
  // rounding.
  std::optional<double> volume;
  std::optional<int> components;
  std::optional<int> genus;
  std::optional<int> cavities;
  bool is_exact = false;  // all coordinates stay on a lattice
  // How far the operands were moved off what is expected, over their size.
  double perturbation = 0.0;
};

// The pair of that kind and seed.  Pegs, touching boxes, cavities and worlds
// take the five poses of the voxel solids in turn.
SolidPair MakeRandomPair(PairKind kind, std::uint64_t seed);

}  // namespace phongpd
