// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact_space/cells.h"

namespace phongpd::internal {

// The boundary of the free cells as an indexed surface, before rounding.
struct ExactSurface {
  std::vector<int> vertex_points;   // ExactPoints id of each vertex
  std::vector<char> pinned;         // vertices that must survive merging
  std::vector<Triangle> triangles;  // outward: normals point into free space
  std::vector<int> facet;           // convolution facet of each triangle
};

// Takes the free sides whose opposite side is occupied and joins their
// corners.  Around an edge with more than two such triangles they are paired
// across the *occupied* sectors, so solids that only touch stay separate and
// every vertex gets one fan: the result is manifold, with coincident vertices
// where solids touch.  Where one solid touches itself along an edge, both
// sheets would still share the two ends of that edge: each sheet gets a
// mid-point of its own (added to `points`).
// With `outer_only` the shells of cavities are left out.
ExactSurface AssembleSurface(const std::vector<ArrangementFacet>& facets,
                             const EdgeRings& rings, const FreeCells& cells,
                             bool outer_only, ExactPoints* points);

}  // namespace phongpd::internal
