// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/minkowski/arrangement/plane_groups.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// Where a facet meets a plane: a corner in it (point ≥ 0 from the start) or
// edge a–b crossing it, which becomes a point only if it is needed.
struct Crossing {
  int point = -1;
  int a = 0, b = 0;  // convolution points
  Int128 side_a = 0, side_b = 0;
  int group = 0;
  double along = 0.0;  // coordinate on the line's dominant axis
};

// Two facets and the segment they share, or one point (low = high).
struct Intersection {
  int first, second;
  Crossing low, high;
  bool is_point;
};

// Finds what two facets share; const and thread-safe.  What it is given stays
// with the caller.
class FacetIntersector {
 public:
  // point_ids: of every point of the convolution, for Crossing::point.
  FacetIntersector(const Convolution& convolution, const PlaneGroups& groups,
                   const std::vector<int>& point_ids);

  // Do the facets t and u, of different planes, meet?  Sets *intersection if
  // so.
  bool Intersect(int t, int u, Intersection* intersection) const;

  LocatedPoint LocateCrossing(const Crossing& c) const;  // of an edge
  Eigen::Vector3d Approximate(const Crossing& c) const {
    return Locate(c).approximate;
  }

 private:
  struct Sides;

  const Triangle& Corners(int facet) const {
    return convolution_.facets[facet].corners;
  }
  bool IsBeside(int facet, int of) const;
  Sides SidesOf(int facet, int plane_facet) const;
  int CommonLineAxis(int t, int u) const;
  int Crossings(int facet, const Sides& sides, int group, int axis,
                Crossing* out) const;
  int Compare(const Crossing& a, const Crossing& b, int axis) const;
  LocatedPoint Locate(const Crossing& c) const;

  const Convolution& convolution_;
  const PlaneGroups& groups_;
  const std::vector<int>& point_ids_;
  std::vector<RoundedPlane> planes_;                     // of the groups
  std::vector<std::array<Eigen::Vector3d, 3>> corners_;  // of the facets
};

}  // namespace phongpd::internal
