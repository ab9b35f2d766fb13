// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

// Pairs of solids of whose convolution much is hidden inside C_obj, and for
// comparison some of which hardly anything is.
namespace phongpd {

// A tube of unit cells along the first ones of Hilbert's space-filling curve
// through the 4 × 4 × 4 points with even coordinates, 1 ≤ cells ≤ 127: 4·cells
// + 2 squares, each of two triangles.
TriangleMesh MakeHilbertTube(int cells);

struct HiddenPair {
  std::string name;
  TriangleMesh robot, obstacle;
  bool is_hiding = false;  // facets of the convolution that culling can find
};

// Each takes about a second or less to build by detail 1; edges are half as
// long by detail 2.
// Knots, spikes, organic and scanned bodies, tori, tubes; turned and on a
// common lattice; several overlapping components; cavities.
std::vector<HiddenPair> HiddenPairs(int detail);

}  // namespace phongpd
