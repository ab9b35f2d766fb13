// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/convolution.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Relative bound on a double dot product of a rounded normal with an exact
// vector: three products and two sums of terms rounded once, with room.
constexpr double kDotError = 1e-14;

// Direction of the symbolic rotation.  Its components have no short integer
// relation, so first-order terms of grid vectors do not vanish.
const Vector3d kAxis(0.37170913265849731, 0.56291826475183729,
                     0.73831572046135197);

// n · (ω × d) = d · (n × ω), accurate enough to trust the sign: the true value
// of a non-zero term is far above 2^-100 of its parts.
int RotationTerm(const GridNormal& n, const GridPoint& d) {
  Float128 sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    sum += Float128(d[k]) *
           (Float128(n[i]) * kAxis[j] - Float128(n[j]) * kAxis[i]);
  }
  return Sign(sum);
}

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

// Vertices of `stars` that a facet with normal n can touch.  `turn` is +1 when
// the stars belong to the turned operand Q, −1 when the facet does.
std::vector<int> TouchedVertices(const GridNormal& n, const VertexStars& stars,
                                 int turn) {
  std::vector<int> touched;
  const Vector3d nd = ToDouble(n);
  const double bound = nd.lpNorm<1>() * kDotError;
  const int count = static_cast<int>(stars.begin.size()) - 1;
  for (int v = 0; v < count; ++v) {
    const int end = stars.begin[v + 1];
    bool below = stars.begin[v] < end;
    for (int k = stars.begin[v]; below && k < end; ++k) {
      const Vector3d& d = stars.rays[k];
      const double side = nd.dot(d);
      const double error = bound * d.lpNorm<1>();
      if (side < -error) continue;
      if (side > error) {
        below = false;
        break;
      }
      int sign = Sign(Dot(n, stars.exact[k]));
      if (sign == 0) sign = turn * RotationTerm(n, stars.exact[k]);
      below = sign < 0;
    }
    if (below) touched.push_back(v);
  }
  return touched;
}

// A strictly convex edge: its direction and the two apex directions.
struct ConvexEdge {
  int a, b;
  GridPoint exact[3];
  Vector3d rounded[3];
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
    edges.push_back(c);
  }
  return edges;
}

// First-order side of apex `o` of the plane spanned by e and the turned g; the
// apex turns too when it belongs to Q.
int TurnedSide(const ConvexEdge& e, const ConvexEdge& g, const GridNormal& n,
               const GridPoint& o, bool of_q) {
  // e × (ω × g) · o, with ω × g and the outer product expanded.
  Float128 turned[3];
  const GridPoint& gd = g.exact[0];
  const GridPoint& ed = e.exact[0];
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    turned[k] = Float128(kAxis[i]) * gd[j] - Float128(kAxis[j]) * gd[i];
  }
  Float128 sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    sum += (Float128(ed[i]) * turned[j] - Float128(ed[j]) * turned[i]) * o[k];
    if (of_q) {
      sum += Float128(n[k]) *
             (Float128(kAxis[i]) * o[j] - Float128(kAxis[j]) * o[i]);
    }
  }
  return Sign(sum);
}

// Side of the plane spanned by e and g on which all four apices lie, or 0.
int CommonSide(const ConvexEdge& e, const ConvexEdge& g) {
  const Vector3d n = e.rounded[0].cross(g.rounded[0]);
  const double error =
      (n.lpNorm<1>() + e.rounded[0].lpNorm<Eigen::Infinity>() *
                           g.rounded[0].lpNorm<Eigen::Infinity>()) *
      kDotError;
  int common = 0;
  for (int k = 0; k < 4; ++k) {
    const bool of_q = k >= 2;
    const int apex = 1 + k % 2;
    const Vector3d& o = of_q ? g.rounded[apex] : e.rounded[apex];
    const double side = n.dot(o);
    int sign = 0;
    if (std::abs(side) > error * o.lpNorm<1>()) {
      sign = Sign(side);
    } else {
      const GridNormal exact = Cross(e.exact[0], g.exact[0]);
      const GridPoint& p = of_q ? g.exact[apex] : e.exact[apex];
      sign = Sign(Dot(exact, p));
      if (sign == 0) sign = TurnedSide(e, g, exact, p, of_q);
    }
    if (sign == 0 || (common != 0 && sign != common)) return 0;
    common = sign;
  }
  return common;
}

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
    if (!seen_.emplace(first, true).second) return;
    out_->facets.push_back({t, n, source, kind});
  }

 private:
  Convolution* out_;
  std::unordered_map<GridPoint, int, GridPointHash> ids_;
  std::map<Triangle, bool> seen_;
};

}  // namespace

Convolution ReducedConvolution(const GridSolid& p, const GridSolid& q) {
  Convolution out;
  Collector collect(&out);
  int source = 0;

  const auto add_facets = [&](const GridSolid& facets, const GridSolid& others,
                              ContactKind kind) {
    const VertexStars stars(others);
    const int turn = kind == ContactKind::kObstacleFacet ? 1 : -1;
    std::vector<std::vector<int>> touched(facets.facets.size());
    tbb::parallel_for(std::size_t{0}, touched.size(), [&](std::size_t f) {
      touched[f] = TouchedVertices(facets.normals[f], stars, turn);
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
  tbb::parallel_for(std::size_t{0}, pe.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < qe.size(); ++j) {
      const int side = CommonSide(pe[i], qe[j]);
      if (side != 0) hits[i].push_back({static_cast<int>(j), side});
    }
  });
  for (std::size_t i = 0; i < pe.size(); ++i) {
    for (const Hit& hit : hits[i]) {
      const ConvexEdge &e = pe[i], &g = qe[hit.edge];
      GridNormal n = Cross(e.exact[0], g.exact[0]);
      if (IsZero(n)) continue;  // parallel: the parallelogram has no area
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
