// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/minkowski/gauss_tree.h"
#include "core/minkowski/symbolic_turn.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Relative bound on a double dot product of a rounded normal with an exact
// vector: three products and two sums of terms rounded once, with room.
constexpr double kDotError = 1e-14;

// Vectors from every vertex to its neighbours, contiguous for the inner loop.
struct VertexStars {
  explicit VertexStars(const GridSolid& s) {
    begin.reserve(s.vertices.size() + 1);
    for (std::size_t v = 0; v < s.vertices.size(); ++v) {
      begin.push_back(static_cast<int>(rays.size()));
      for (const int w : s.neighbors[v]) {
        exact.push_back(s.vertices[w] - s.vertices[v]);
        rays.push_back(ToDouble(exact.back()));
      }
    }
    begin.push_back(static_cast<int>(rays.size()));
  }
  std::vector<int> begin;
  std::vector<Vector3d> rays;
  std::vector<GridPoint> exact;
};

// The caps of the normals around every vertex.
//
// Let n·d ≤ 0 for all rays d at v, and let the normals mᵢ of the facets there
// lie in a cap of less than 90° around a.  Seen along a the facets cover every
// direction, and x ↦ n·x over them is piecewise linear with gradients gᵢ.  Were
// gᵢ·u > 0 for all i and one u, n·x would grow along u: so Σ wᵢ gᵢ = 0 for some
// wᵢ ≥ 0, which is n = ± Σ wᵢ mᵢ / |…|.  Hence n or −n is in the cap.
GaussTree VertexCaps(const GridSolid& s) {
  std::vector<std::vector<Vector3d>> normals(s.vertices.size());
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    const Vector3d n = ToDouble(s.normals[f]).normalized();
    for (const int v : s.facets[f]) normals[v].push_back(n);
  }
  std::vector<GaussCap> caps;
  caps.reserve(normals.size());
  for (const std::vector<Vector3d>& around : normals) {
    caps.push_back(CapAround(around.data(), around.size()));
  }
  return GaussTree(std::move(caps));
}

// Vertices of `stars` that a facet with normal n can touch.  `turn` is +1 when
// the stars belong to the turned operand Q, −1 when the facet does.
std::vector<int> TouchedVertices(const GridNormal& n, const VertexStars& stars,
                                 const GaussTree& caps, int turn) {
  std::vector<int> candidates, touched, unclear;
  const Vector3d nd = ToDouble(n);
  const double bound = nd.lpNorm<1>() * kDotError;
  const Vector3d unit = nd.normalized();
  for (const Vector3d& side : {unit, Vector3d(-unit)}) {
    caps.ForEachNear({side, 0.0}, [&](int v) { candidates.push_back(v); });
  }
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()),
                   candidates.end());
  for (const int v : candidates) {
    const int begin = stars.begin[v], end = stars.begin[v + 1];
    bool below = begin < end;
    unclear.clear();
    for (int k = begin; below && k < end; ++k) {
      const Vector3d& d = stars.rays[k];
      const double side = nd.dot(d);
      const double error = bound * d.lpNorm<1>();
      if (side > error) below = false;
      if (side >= -error) unclear.push_back(k);
    }
    // Exact arithmetic only where no clear sign has decided.
    for (std::size_t i = 0; below && i < unclear.size(); ++i) {
      const GridPoint& d = stars.exact[unclear[i]];
      int sign = Sign(Dot(n, d));
      if (sign == 0) sign = turn * TurnedSign(n, d);
      below = sign < 0;
    }
    if (below) touched.push_back(v);
  }
  return touched;
}

// A strictly convex edge: its direction and the two apex directions, and the
// unit normals of its facets.
struct ConvexEdge {
  int a, b;
  GridPoint exact[3];
  Vector3d rounded[3];
  Vector3d left_normal, right_normal;
};

std::vector<ConvexEdge> ConvexEdges(const GridSolid& s) {
  std::vector<ConvexEdge> edges;
  for (const GridEdge& e : s.edges) {
    const GridPoint& a = s.vertices[e.a];
    if (Dot(s.normals[e.left], s.vertices[e.right_apex] - a) >= 0) continue;
    ConvexEdge c;
    c.a = e.a;
    c.b = e.b;
    c.exact[0] = s.vertices[e.b] - a;
    c.exact[1] = s.vertices[e.left_apex] - a;
    c.exact[2] = s.vertices[e.right_apex] - a;
    for (int k = 0; k < 3; ++k) c.rounded[k] = ToDouble(c.exact[k]);
    c.left_normal = ToDouble(s.normals[e.left]).normalized();
    c.right_normal = ToDouble(s.normals[e.right]).normalized();
    edges.push_back(c);
  }
  return edges;
}

// The normals n with which an edge can be touched: those for which both apices
// lie below the plane through it, the arc between its facets' normals.  Edges
// touch where their arcs cross.
GaussCap ArcCap(const ConvexEdge& e) {
  const Vector3d normals[2] = {e.left_normal, e.right_normal};
  return CapAround(normals, 2);
}

GaussTree ArcCaps(const std::vector<ConvexEdge>& edges) {
  std::vector<GaussCap> caps;
  caps.reserve(edges.size());
  for (const ConvexEdge& e : edges) caps.push_back(ArcCap(e));
  return GaussTree(std::move(caps));
}

// Side of the plane spanned by e and g on which all four apices lie, or 0.
int CommonSide(const ConvexEdge& e, const ConvexEdge& g) {
  const Vector3d n = e.rounded[0].cross(g.rounded[0]);
  const double error =
      (n.lpNorm<1>() + e.rounded[0].lpNorm<Eigen::Infinity>() *
                           g.rounded[0].lpNorm<Eigen::Infinity>()) *
      kDotError;
  const Vector3d* apices[4] = {&e.rounded[1], &e.rounded[2], &g.rounded[1],
                               &g.rounded[2]};
  int signs[4], common = 0;
  for (int k = 0; k < 4; ++k) {
    const double side = n.dot(*apices[k]);
    const bool clear = std::abs(side) > error * apices[k]->lpNorm<1>();
    signs[k] = clear ? Sign(side) : 0;
    if (signs[k] == 0) continue;
    if (common != 0 && signs[k] != common) return 0;
    common = signs[k];
  }
  // Exact arithmetic only where no clear sign has decided.
  const GridNormal exact = Cross(e.exact[0], g.exact[0]);
  if (IsZero(exact)) return 0;  // parallel: a parallelogram without area
  for (int k = 0; k < 4; ++k) {
    if (signs[k] != 0) continue;
    const bool of_q = k >= 2;
    const GridPoint& apex = (of_q ? g : e).exact[1 + k % 2];
    int sign = Sign(Dot(exact, apex));
    // (e × g)·o = g·(o × e) = e·(g × o): the other edge against the normal of
    // the apex's facet, with P or Q turned.
    if (sign == 0) {
      sign = of_q ? -TurnedSign(Cross(g.exact[0], apex), e.exact[0])
                  : TurnedSign(Cross(apex, e.exact[0]), g.exact[0]);
    }
    if (common != 0 && sign != common) return 0;
    common = sign;
  }
  return common;
}

struct TriangleHash {
  std::size_t operator()(const Triangle& t) const {
    return GridPointHash()({t[0], t[1], t[2]});
  }
};

// Collects facets over shared, distinct points; a triangle generated twice
// (several contacts at one place) is kept once.
class Collector {
 public:
  explicit Collector(Convolution* out) : out_(out) {}

  int Point(const GridPoint& sum) {
    const auto [it, is_new] =
        ids_.emplace(sum, static_cast<int>(out_->points.size()));
    if (is_new) out_->points.push_back(sum);
    return it->second;
  }
  void Add(Triangle t, const GridNormal& n, ContactKind kind, int source) {
    Triangle first = t;
    std::rotate(first.begin(), std::min_element(first.begin(), first.end()),
                first.end());
    if (!seen_.insert(first).second) return;
    out_->facets.push_back({t, n, source, kind});
  }

 private:
  Convolution* out_;
  std::unordered_map<GridPoint, int, GridPointHash> ids_;
  std::unordered_set<Triangle, TriangleHash> seen_;
};

}  // namespace

Convolution ReducedConvolution(const GridSolid& p, const GridSolid& q) {
  Convolution out;
  Collector collect(&out);
  int source = 0;

  const auto add_facets = [&](const GridSolid& facets, const GridSolid& others,
                              ContactKind kind) {
    const VertexStars stars(others);
    const GaussTree caps = VertexCaps(others);
    const int turn = kind == ContactKind::kObstacleFacet ? 1 : -1;
    std::vector<std::vector<int>> touched(facets.facets.size());
    tbb::parallel_for(std::size_t{0}, touched.size(), [&](std::size_t f) {
      touched[f] = TouchedVertices(facets.normals[f], stars, caps, turn);
    });
    for (std::size_t f = 0; f < touched.size(); ++f) {
      for (const int v : touched[f]) {
        Triangle t;
        for (int k = 0; k < 3; ++k) {
          t[k] = collect.Point(facets.vertices[facets.facets[f][k]] +
                               others.vertices[v]);
        }
        collect.Add(t, facets.normals[f], kind, source++);
      }
    }
  };
  add_facets(p, q, ContactKind::kObstacleFacet);
  add_facets(q, p, ContactKind::kRobotFacet);

  const std::vector<ConvexEdge> pe = ConvexEdges(p), qe = ConvexEdges(q);
  struct Hit {
    int edge, side;
  };
  std::vector<std::vector<Hit>> hits(pe.size());
  const GaussTree arcs = ArcCaps(qe);
  const tbb::blocked_range<std::size_t> all(0, pe.size());
  tbb::parallel_for(all, [&](const tbb::blocked_range<std::size_t>& range) {
    std::vector<int> candidates;
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      candidates.clear();
      arcs.ForEachNear(ArcCap(pe[i]), [&](int j) { candidates.push_back(j); });
      std::sort(candidates.begin(), candidates.end());
      for (const int j : candidates) {
        const int side = CommonSide(pe[i], qe[j]);
        if (side != 0) hits[i].push_back({j, side});
      }
    }
  });
  for (std::size_t i = 0; i < pe.size(); ++i) {
    for (const Hit& hit : hits[i]) {
      const ConvexEdge &e = pe[i], &g = qe[hit.edge];
      GridNormal n = Cross(e.exact[0], g.exact[0]);
      const int c0 = collect.Point(p.vertices[e.a] + q.vertices[g.a]);
      int c1 = collect.Point(p.vertices[e.b] + q.vertices[g.a]);
      const int c2 = collect.Point(p.vertices[e.b] + q.vertices[g.b]);
      int c3 = collect.Point(p.vertices[e.a] + q.vertices[g.b]);
      if (hit.side > 0) {  // outward is away from the apices
        n = Negated(n);
        std::swap(c1, c3);
      }
      collect.Add({c0, c1, c2}, n, ContactKind::kEdges, source);
      collect.Add({c0, c2, c3}, n, ContactKind::kEdges, source);
      ++source;
    }
  }
  return out;
}

}  // namespace phongpd::internal
