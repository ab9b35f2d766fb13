// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tuple>
#include <vector>

#include "core/bvh/box_tree.h"
#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/occupied_region.h"
#include "core/minkowski/operands/exact_points.h"

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

// Boxes of the convolution's facets in a tree.
struct FacetIndex {
  explicit FacetIndex(const Convolution& convolution);
  // What they have in `window`, which they all meet: facets that meet outside
  // are not found.
  FacetIndex(const Convolution& convolution, const BoundingBox& window);
  std::vector<BoundingBox> boxes;
  BoxTree tree;
};

// Expected counts, from an even sample of the facets: what every later stage
// costs grows with them.
struct ExpectedCuts {
  double meetings = 0.0;  // facet pairs that IntersectFacets will cut
  // Pairs of segments in which others cut a facet that cross in it, counted in
  // each of the three facets.
  double crossings = 0.0;
};
ExpectedCuts ExpectCuts(const Convolution& convolution,
                        const PlaneGroups& groups, const FacetIndex& index,
                        const BuildLimits& limits,
                        const OccupiedRegion* occupied = nullptr);

// Intersects all facets of different planes whose boxes meet.  Sides are
// decided in 128-bit integers, overlaps along the common line in double with
// an exact fallback, and only end points that survive are constructed.  What
// two facets share in the `occupied` region, if there is one, is left out.
// Throws InputError when `limits` are passed.
FacetIntersections IntersectFacets(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   const FacetIndex& index,
                                   const BuildLimits& limits,
                                   ExactPoints* points,
                                   const OccupiedRegion* occupied = nullptr);

}  // namespace phongpd::internal
