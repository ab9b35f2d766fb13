// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact_space/convolution.h"
#include "core/contact_space/exact_points.h"
#include "core/contact_space/facet_intersections.h"
#include "core/contact_space/plane_groups.h"

namespace phongpd::internal {

// A triangle of the arrangement: no other facet passes through its interior.
struct ArrangementFacet {
  Triangle corners;  // into ExactPoints, oriented as `facet`
  int facet;         // a convolution facet of the same plane and orientation
  // A facet of the opposite orientation covers the same place, so both sides
  // are behind a facet.
  bool two_sided;
};

// Cuts every plane along its intersection segments: one exact constrained
// triangulation per plane group, of which only the places covered by a
// convolution facet are kept.  New vertices (crossings of segments) are added
// to `points`.  Groups are independent and run in parallel; the result does
// not depend on the number of threads.
std::vector<ArrangementFacet> SubdividePlanes(
    const Convolution& convolution, const PlaneGroups& groups,
    const FacetIntersections& intersections, ExactPoints* points);

}  // namespace phongpd::internal
