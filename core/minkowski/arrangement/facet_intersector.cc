// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/arrangement/facet_intersector.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace phongpd::internal {

// Signed volumes of the corners of one facet over the plane of another; a
// corner both facets share is exactly 0.
struct FacetIntersector::Sides {
  std::array<Int128, 3> value;
  // Can the facet reach the plane beyond a shared corner?
  bool Meets(int shared) const {
    int above = 0, below = 0;
    for (const Int128 v : value) {
      above += v > 0;
      below += v < 0;
    }
    return above + shared < 3 && below + shared < 3;
  }
};

FacetIntersector::FacetIntersector(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   const std::vector<int>& point_ids)
    : convolution_(convolution), groups_(groups), point_ids_(point_ids) {
  for (const GridPlane& plane : groups.planes) planes_.emplace_back(plane);
  corners_.reserve(convolution.facets.size());
  for (const ConvolutionFacet& f : convolution.facets) {
    corners_.push_back({ToDouble(convolution.points[f.corners[0]]),
                        ToDouble(convolution.points[f.corners[1]]),
                        ToDouble(convolution.points[f.corners[2]])});
  }
}

bool FacetIntersector::Intersect(int t, int u,
                                 Intersection* intersection) const {
  if (IsBeside(t, u) || IsBeside(u, t)) return false;
  intersection->first = t;
  intersection->second = u;
  intersection->is_point = false;
  Crossing shared[3];
  int count = 0;
  for (const int a : Corners(t)) {
    for (const int b : Corners(u)) {
      if (a != b) continue;
      shared[count].a = a;
      shared[count++].point = point_ids_[a];
    }
  }
  if (count >= 2) {
    // The common edge may be interior (cancelled) in either plane's group,
    // where nothing else would put it.
    intersection->low = shared[0];
    intersection->high = shared[1];
    return true;
  }
  const Sides of_u = SidesOf(u, t);
  if (!of_u.Meets(count)) return false;
  const Sides of_t = SidesOf(t, u);
  if (!of_t.Meets(count)) return false;

  const int axis = CommonLineAxis(t, u);
  Crossing a[2], b[2];
  const int na = Crossings(u, of_u, groups_.of_facet[t], axis, a);
  const int nb = Crossings(t, of_t, groups_.of_facet[u], axis, b);
  if (na == 0 || nb == 0) return false;
  if (na == 1) a[1] = a[0];
  if (nb == 1) b[1] = b[0];
  if (Compare(a[0], a[1], axis) > 0) std::swap(a[0], a[1]);
  if (Compare(b[0], b[1], axis) > 0) std::swap(b[0], b[1]);
  intersection->low = Compare(a[0], b[0], axis) >= 0 ? a[0] : b[0];
  intersection->high = Compare(a[1], b[1], axis) <= 0 ? a[1] : b[1];
  const int order = Compare(intersection->low, intersection->high, axis);
  intersection->is_point = order == 0;
  return order <= 0;
}

LocatedPoint FacetIntersector::LocateCrossing(const Crossing& c) const {
  PointDefinition edge;
  edge.kind = PointDefinition::kEdge;
  edge.a = convolution_.points[c.a];
  edge.b = convolution_.points[c.b];
  edge.side_a = c.side_a;
  edge.side_b = c.side_b;
  return internal::Locate(edge);
}

// Is the facet clearly on one side of the other's plane?
bool FacetIntersector::IsBeside(int facet, int of) const {
  const RoundedPlane& plane = planes_[groups_.of_facet[of]];
  const std::array<Eigen::Vector3d, 3>& corners = corners_[facet];
  const int side = plane.Side(corners[0]);
  return side != 0 && plane.Side(corners[1]) == side &&
         plane.Side(corners[2]) == side;
}

FacetIntersector::Sides FacetIntersector::SidesOf(int facet,
                                                  int plane_facet) const {
  const Triangle& reference = Corners(plane_facet);
  const GridPoint& origin = convolution_.points[reference[0]];
  Sides sides;
  for (int k = 0; k < 3; ++k) {
    const int v = Corners(facet)[k];
    const bool shared =
        v == reference[0] || v == reference[1] || v == reference[2];
    sides.value[k] = shared ? Int128(0)
                            : Dot(convolution_.facets[plane_facet].normal,
                                  convolution_.points[v] - origin);
  }
  return sides;
}

// A coordinate that varies along the common line of two planes.
int FacetIntersector::CommonLineAxis(int t, int u) const {
  const GridNormal& n = convolution_.facets[t].normal;
  const GridNormal& m = convolution_.facets[u].normal;
  const Eigen::Vector3d rounded =
      ToDouble(n).normalized().cross(ToDouble(m).normalized());
  if (rounded.lpNorm<Eigen::Infinity>() > 1e-8) return LargestAxis(rounded);
  return LargestAxis(WideCross(n, m));
}

int FacetIntersector::Crossings(int facet, const Sides& sides, int group,
                                int axis, Crossing* out) const {
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const int a = Corners(facet)[k], b = Corners(facet)[(k + 1) % 3];
    const Int128 sa = sides.value[k], sb = sides.value[(k + 1) % 3];
    const double xa = static_cast<double>(convolution_.points[a][axis]);
    if (sa == 0 && count < 2) {
      out[count].point = point_ids_[a];
      out[count].a = a;
      out[count++].along = xa;
    } else if (Sign(sa) * Sign(sb) < 0 && count < 2) {
      const double xb = static_cast<double>(convolution_.points[b][axis]);
      const double da = static_cast<double>(sa), db = static_cast<double>(sb);
      const double along = xa + (xb - xa) * (da / (da - db));
      // One name for the edge, whichever facet it is met from.
      out[count++] = a < b ? Crossing{-1, a, b, sa, sb, group, along}
                           : Crossing{-1, b, a, sb, sa, group, along};
    }
  }
  return count;
}

int FacetIntersector::Compare(const Crossing& a, const Crossing& b,
                              int axis) const {
  if (a.point >= 0 && a.point == b.point) return 0;
  const double difference = a.along - b.along;
  if (std::abs(difference) > 2 * kPointError) return Sign(difference);
  return CompareCoordinate(Locate(a), Locate(b), axis);
}

LocatedPoint FacetIntersector::Locate(const Crossing& c) const {
  if (c.point < 0) return LocateCrossing(c);
  PointDefinition vertex;
  vertex.a = convolution_.points[c.a];
  return internal::Locate(vertex);
}

}  // namespace phongpd::internal
