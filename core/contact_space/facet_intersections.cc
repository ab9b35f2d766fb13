// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/facet_intersections.h"

#include <CGAL/Box_intersection_d/Box_d.h>
#include <CGAL/box_intersection_d.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace phongpd::internal {
namespace {

struct FacetPair {
  int first, second;
};

// Facets whose boxes meet and whose planes differ.
std::vector<FacetPair> CandidatePairs(const Convolution& convolution,
                                      const PlaneGroups& groups) {
  using Box =
      CGAL::Box_intersection_d::Box_d<double, 3,
                                      CGAL::Box_intersection_d::ID_EXPLICIT>;
  struct FacetBox : Box {
    FacetBox(double* low, double* high, int facet_index)
        : Box(low, high), facet(facet_index) {}
    int facet;
  };
  std::vector<FacetBox> boxes;
  boxes.reserve(convolution.facets.size());
  for (std::size_t f = 0; f < convolution.facets.size(); ++f) {
    const Triangle& t = convolution.facets[f].corners;
    Eigen::Array3d low = ToDouble(convolution.points[t[0]]), high = low;
    for (int k = 1; k < 3; ++k) {
      const Eigen::Array3d p = ToDouble(convolution.points[t[k]]);
      low = low.min(p);
      high = high.max(p);
    }
    boxes.emplace_back(low.data(), high.data(), static_cast<int>(f));
  }
  std::vector<FacetPair> pairs;
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const FacetBox& a, const FacetBox& b) {
        if (groups.of_facet[a.facet] == groups.of_facet[b.facet]) return;
        pairs.push_back(
            {std::min(a.facet, b.facet), std::max(a.facet, b.facet)});
      });
  tbb::parallel_sort(
      pairs.begin(), pairs.end(), [](const FacetPair& a, const FacetPair& b) {
        return a.first != b.first ? a.first < b.first : a.second < b.second;
      });
  return pairs;
}

// Signed volumes of the corners of one facet over the plane of another; a
// corner both facets share is exactly 0.
struct Sides {
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

class Intersector {
 public:
  Intersector(const Convolution& convolution, const PlaneGroups& groups,
              ExactPoints* points, FacetIntersections* out)
      : convolution_(convolution),
        groups_(groups),
        points_(points),
        out_(out),
        // Far above the rounding of a point on a line, far below a grid step.
        tolerance_(std::ldexp(1.0, kGridBits + 1) * 1e-12) {}

  int SharedCorners(const FacetPair& pair) const {
    int shared = 0;
    for (const int a : Corners(pair.first)) {
      for (const int b : Corners(pair.second)) shared += a == b;
    }
    return shared;
  }

  Sides SidesOf(int facet, int plane_facet) const {
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

  // Might the two facets share more than corners?  Thread-safe.
  bool MayMeet(const FacetPair& pair) const {
    const int shared = SharedCorners(pair);
    if (shared >= 2) return true;
    return SidesOf(pair.second, pair.first).Meets(shared) &&
           SidesOf(pair.first, pair.second).Meets(shared);
  }

  void Intersect(const FacetPair& pair) {
    const int t = pair.first, u = pair.second;
    if (SharedCorners(pair) >= 2) {
      // The common edge may be interior (cancelled) in either plane's group,
      // where nothing else would put it.
      int ends[3], count = 0;
      for (const int a : Corners(t)) {
        for (const int b : Corners(u)) {
          if (a == b) ends[count++] = out_->point_ids[a];
        }
      }
      Emit(t, u, ends[0], ends[1]);
      return;
    }
    const int axis = CommonLineAxis(t, u);
    Crossing a[2], b[2];
    const int na = Crossings(u, SidesOf(u, t), groups_.of_facet[t], axis, a);
    const int nb = Crossings(t, SidesOf(t, u), groups_.of_facet[u], axis, b);
    if (na == 0 || nb == 0) return;
    if (na == 1) a[1] = a[0];
    if (nb == 1) b[1] = b[0];
    if (Compare(&a[0], &a[1], axis) > 0) std::swap(a[0], a[1]);
    if (Compare(&b[0], &b[1], axis) > 0) std::swap(b[0], b[1]);
    Crossing low = Compare(&a[0], &b[0], axis) >= 0 ? a[0] : b[0];
    Crossing high = Compare(&a[1], &b[1], axis) <= 0 ? a[1] : b[1];
    const int order = Compare(&low, &high, axis);
    if (order > 0) return;
    const int from = Materialize(&low);
    Emit(t, u, from, order == 0 ? from : Materialize(&high));
  }

 private:
  // Where a facet meets a plane: a corner in it (point ≥ 0 from the start) or
  // edge a–b crossing it, built only on demand.
  struct Crossing {
    int point = -1;
    int a = 0, b = 0;  // convolution points
    Int128 side_a = 0, side_b = 0;
    int group = 0;
    double along = 0.0;  // coordinate on the line's dominant axis
  };

  const Triangle& Corners(int facet) const {
    return convolution_.facets[facet].corners;
  }

  // Coordinate in which the common line of two planes varies most.
  int CommonLineAxis(int t, int u) const {
    const GridNormal& n = convolution_.facets[t].normal;
    const GridNormal& m = convolution_.facets[u].normal;
    std::array<Float128, 3> direction;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      direction[k] =
          Float128(n[i]) * Float128(m[j]) - Float128(n[j]) * Float128(m[i]);
    }
    return LargestAxis(direction);
  }

  int Crossings(int facet, const Sides& sides, int group, int axis,
                Crossing* out) const {
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = Corners(facet)[k], b = Corners(facet)[(k + 1) % 3];
      const Int128 sa = sides.value[k], sb = sides.value[(k + 1) % 3];
      const double xa = static_cast<double>(convolution_.points[a][axis]);
      const double xb = static_cast<double>(convolution_.points[b][axis]);
      if (sa == 0 && count < 2) {
        out[count].point = out_->point_ids[a];
        out[count++].along = xa;
      } else if (Sign(sa) * Sign(sb) < 0 && count < 2) {
        const double da = static_cast<double>(sa), db = static_cast<double>(sb);
        out[count++] = {
            -1, a, b, sa, sb, group, xa + (xb - xa) * (da / (da - db))};
      }
    }
    return count;
  }

  int Compare(Crossing* a, Crossing* b, int axis) {
    if (a->point >= 0 && a->point == b->point) return 0;
    if (a->along < b->along - tolerance_) return -1;
    if (a->along > b->along + tolerance_) return 1;
    const int p = Materialize(a), q = Materialize(b);
    if (p == q) return 0;
    return CompareCoordinate((*points_)[p], (*points_)[q], axis);
  }

  int Materialize(Crossing* c) {
    if (c->point < 0) c->point = EdgePlanePoint(*c);
    return c->point;
  }

  // p = a + (b − a)·s_a/(s_a − s_b), once per edge and plane.
  int EdgePlanePoint(Crossing c) {
    if (c.a > c.b) {
      std::swap(c.a, c.b);
      std::swap(c.side_a, c.side_b);
    }
    const EdgePlane key = {c.a, c.b, c.group};
    const auto it = edge_points_.find(key);
    if (it != edge_points_.end()) return it->second;
    PointDefinition edge;
    edge.kind = PointDefinition::kEdge;
    edge.a = convolution_.points[c.a];
    edge.b = convolution_.points[c.b];
    edge.side_a = c.side_a;
    edge.side_b = c.side_b;
    const int id = points_->Add(Locate(edge));
    edge_points_.emplace(key, id);
    return id;
  }

  void Emit(int t, int u, int from, int to) {
    const int g = groups_.of_facet[t], h = groups_.of_facet[u];
    const auto [low, high] = std::minmax(from, to);
    out_->segments[g].push_back({low, high, h});
    out_->segments[h].push_back({low, high, g});
  }

  using EdgePlane = std::array<std::int64_t, 3>;

  const Convolution& convolution_;
  const PlaneGroups& groups_;
  ExactPoints* points_;
  FacetIntersections* out_;
  double tolerance_;
  std::unordered_map<EdgePlane, int, GridPointHash> edge_points_;
};

}  // namespace

FacetIntersections IntersectFacets(const Convolution& convolution,
                                   const PlaneGroups& groups,
                                   ExactPoints* points) {
  FacetIntersections out;
  out.segments.resize(groups.members.size());
  out.point_ids.assign(convolution.points.size(), -1);
  for (const ConvolutionFacet& facet : convolution.facets) {
    for (const int v : facet.corners) {
      if (out.point_ids[v] >= 0) continue;
      PointDefinition vertex;
      vertex.a = convolution.points[v];
      out.point_ids[v] = points->Add(Locate(vertex));
    }
  }
  std::vector<FacetPair> pairs = CandidatePairs(convolution, groups);
  Intersector intersector(convolution, groups, points, &out);
  std::vector<char> may_meet(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    may_meet[i] = intersector.MayMeet(pairs[i]);
  });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (may_meet[i]) intersector.Intersect(pairs[i]);
  }
  tbb::parallel_for(std::size_t{0}, out.segments.size(), [&](std::size_t g) {
    std::vector<PlaneSegment>& s = out.segments[g];
    std::sort(s.begin(), s.end());
    s.erase(std::unique(s.begin(), s.end(),
                        [](const PlaneSegment& a, const PlaneSegment& b) {
                          return a.from == b.from && a.to == b.to;
                        }),
            s.end());
  });
  return out;
}

}  // namespace phongpd::internal
