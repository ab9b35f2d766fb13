// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>
#include <vector>

#include "core/contact_space/convolution.h"
#include "core/contact_space/exact_points.h"
#include "core/contact_space/plane_groups.h"

namespace phongpd::internal {

// A segment of one plane, cut by another; both ends equal for an isolated
// point.
struct PlaneSegment {
  int from, to;  // ExactPoints ids, from ≤ to
  int cutter;    // plane group that cuts here: its plane contains the segment

  bool operator<(const PlaneSegment& o) const {
    return std::tie(from, to, cutter) < std::tie(o.from, o.to, o.cutter);
  }
};

// Where the facets of other planes cut each plane.
struct FacetIntersections {
  // Id in ExactPoints of every convolution point, −1 when no facet uses it.
  std::vector<int> point_ids;
  // Per plane group: sorted segments with distinct ends.
  std::vector<std::vector<PlaneSegment>> segments;
};

// Intersects all facets of different planes whose boxes meet.  Sides are
// decided in 128-bit integers, overlaps along the common line in double with
// an exact fallback, and only end points that survive are constructed.
FacetIntersections IntersectFacets(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   ExactPoints* points);

}  // namespace phongpd::internal
