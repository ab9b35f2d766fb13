// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/arrangement/facet_intersections.h"
#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// A face of the arrangement: a polygon, perhaps with holes and dangling edges,
// that no facet of another plane passes through.
struct ArrangementFace {
  int facet = 0;  // a convolution facet of the same plane and orientation
  // A facet of the opposite orientation covers the same place, so both sides
  // are behind a facet.
  bool two_sided = false;
  int begin = 0, end = 0;  // its half-edges in Arrangement::half_edges
};

// A directed edge with its face on the left, seen against the face's normal.
struct HalfEdge {
  int from = 0, to = 0;  // ExactPoints ids
  int face = 0;
  int next = 0;  // the following half-edge of the same border loop
};

struct Arrangement {
  std::vector<ArrangementFace> faces;
  std::vector<HalfEdge> half_edges;
};

// Cuts every plane along its intersection segments and keeps the faces that
// some convolution facet covers.  Crossings of segments are added to `points`.
// Planes are independent and run in parallel; the result does not depend on
// the number of threads.  Throws InputError when `limits` are passed.
Arrangement ArrangePlanes(const Convolution& convolution,
                          const PlaneGroups& groups,
                          const FacetIntersections& intersections,
                          const BuildLimits& limits, ExactPoints* points);

}  // namespace phongpd::internal
