// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "core/contact_space/convolution.h"
#include "core/contact_space/exact_points.h"
#include "core/contact_space/plane_groups.h"

namespace phongpd::internal {

// A segment between two exact points; both ends equal for an isolated point.
using PointPair = std::pair<int, int>;

// Where the facets of other planes cut each plane.
struct FacetIntersections {
  // Id in ExactPoints of every convolution point, −1 when no facet uses it.
  std::vector<int> point_ids;
  // Per plane group: sorted, distinct segments, first ≤ second.
  std::vector<std::vector<PointPair>> segments;
};

// Intersects all facets of different planes whose boxes meet.  Sides are
// decided in 128-bit integers, overlaps along the common line in double with
// an exact fallback, and only end points that survive are constructed.
FacetIntersections IntersectFacets(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   ExactPoints* points);

}  // namespace phongpd::internal
