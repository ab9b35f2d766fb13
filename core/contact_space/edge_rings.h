// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact_space/convolution.h"
#include "core/contact_space/exact_points.h"
#include "core/contact_space/plane_subdivision.h"

namespace phongpd::internal {

// Facet i of the arrangement has two sides: 2i looks along its normal (+),
// 2i + 1 against it (−).
inline int PlusSide(int facet) { return 2 * facet; }
inline int MinusSide(int facet) { return 2 * facet + 1; }
inline int OppositeSide(int side) { return side ^ 1; }

// The facets around one edge of the arrangement, counter-clockwise seen
// against the direction low → high.
struct EdgeRing {
  int low = 0, high = 0;  // ExactPoints ids, low < high
  int begin = 0, end = 0;
};
struct RingFacet {
  int facet = 0;
  bool forward = false;  // the facet contains low → high

  // The side that looks towards the next and the previous ring facet.
  int SideToNext() const {
    return forward ? PlusSide(facet) : MinusSide(facet);
  }
  int SideToPrevious() const { return OppositeSide(SideToNext()); }
};
struct EdgeRings {
  std::vector<EdgeRing> rings;
  std::vector<RingFacet> facets;  // of all rings, by [begin, end)
};

// Sorts the facets around every edge.  Angles are compared in double from the
// exact normals; exactly where they lie closer than the rounding could tell
// or the edge is too short to have a reliable direction.
EdgeRings SortAroundEdges(const Convolution& convolution,
                          const std::vector<ArrangementFacet>& facets,
                          const ExactPoints& points);

}  // namespace phongpd::internal
