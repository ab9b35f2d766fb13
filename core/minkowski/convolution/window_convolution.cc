// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/minkowski/convolution/window_convolution.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/minkowski/convolution/facet_collector.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Of a facet's reach: far above the rounding of the separating axes.
constexpr double kClearShare = 1e-9;

ConeTree VertexTree(const GridSolid& s) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(s.vertices.size());
  for (const GridPoint& v : s.vertices) {
    boxes.push_back({ToDouble(v), ToDouble(v)});
  }
  return {boxes, VertexCaps(s)};
}

ConeTree FacetTree(const GridSolid& s) {
  std::vector<GaussCap> caps;
  caps.reserve(s.normals.size());
  for (const GridNormal& normal : s.normals) {
    const Vector3d n = ToDouble(normal).normalized();
    caps.push_back(CapAround(&n, 1));
  }
  return {FacetBoxes(s), caps};
}

ConeTree ArcTree(const GridSolid& s, const std::vector<ConvexEdge>& edges) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(edges.size());
  for (const ConvexEdge& e : edges) {
    const Vector3d a = ToDouble(s.vertices[e.a]);
    const Vector3d b = ToDouble(s.vertices[e.b]);
    boxes.push_back({a.cwiseMin(b), a.cwiseMax(b)});
  }
  return {boxes, ArcCaps(edges)};
}

// The sums of two features in a window, as long as they are no more than
// `most`.  Operand is FeatureSums::Operand, a name that is private there.
class WindowSums {
 public:
  // Facet and vertex, or edge of P, edge of Q and the side of CommonSide.
  using Sum = std::array<int, 3>;

  WindowSums(const BoundingBox& window, std::size_t most)
      : window_(window), most_(most) {}

  // False, and stops, as soon as there are too many.
  template <typename Operand>
  bool FindSums(const Operand& p, const Operand& q) {
    return FindFacets(p, q, &facets_of_p_) && FindFacets(q, p, &facets_of_q_) &&
           FindEdges(p, q);
  }

  // In the order of ReducedConvolution, whatever the trees look like.
  void SortSums() {
    for (std::vector<Sum>* list : {&facets_of_p_, &facets_of_q_, &edges_}) {
      std::sort(list->begin(), list->end());
    }
  }

  const std::vector<Sum>& facets_of_p() const { return facets_of_p_; }
  const std::vector<Sum>& facets_of_q() const { return facets_of_q_; }
  const std::vector<Sum>& edges() const { return edges_; }

 private:
  bool AddSum(std::vector<Sum>* list, const Sum& sum) {
    list->push_back(sum);
    return ++found_ <= most_;
  }

  template <typename Operand>
  bool FindFacets(const Operand& facets, const Operand& others,
                  std::vector<Sum>* list) {
    ForEachPairIn(facets.facets, others.vertices, NormalMatch::kEqualOrOpposite,
                  window_, [&](int f, int v) {
                    return !facets.touching[f].Touches(others.stars, v) ||
                           AddSum(list, {f, v, 0});
                  });
    return found_ <= most_;
  }

  template <typename Operand>
  bool FindEdges(const Operand& p, const Operand& q) {
    ForEachPairIn(p.arcs, q.arcs, NormalMatch::kEqual, window_,
                  [&](int e, int g) {
                    const int side = CommonSide(p.edges[e], q.edges[g]);
                    return side == 0 || AddSum(&edges_, {e, g, side});
                  });
    return found_ <= most_;
  }

  const BoundingBox& window_;
  std::size_t most_;
  std::size_t found_ = 0;
  std::vector<Sum> facets_of_p_, facets_of_q_, edges_;
};

// Collects the facets of sums but for those that come clearly nowhere near the
// window: the boxes of the features tell less.
class WindowFacets {
 public:
  explicit WindowFacets(const BoundingBox& window) : window_(window) {}

  void AddFacet(const GridSolid& solid, int f, const GridPoint& vertex,
                ContactKind kind, const SumOrigin& origin) {
    const std::size_t before = out_.convolution.facets.size();
    collect_.AddFacet(solid, f, vertex, kind, source_++);
    KeepNearFacets(before, origin);
  }

  void AddEdges(const GridSolid& p, const ConvexEdge& e, const GridSolid& q,
                const ConvexEdge& g, int side, const SumOrigin& origin) {
    const std::size_t before = out_.convolution.facets.size();
    collect_.AddEdges(p, e, q, g, side, source_++);
    KeepNearFacets(before, origin);
  }

  WindowConvolution TakeFacets() { return std::move(out_); }

 private:
  // Of the facets from `before` on, which are those of one sum.
  void KeepNearFacets(std::size_t before, const SumOrigin& origin) {
    std::vector<ConvolutionFacet>& facets = out_.convolution.facets;
    std::size_t kept = before;
    for (std::size_t f = before; f < facets.size(); ++f) {
      Vector3d corners[3];
      for (int k = 0; k < 3; ++k) {
        corners[k] = ToDouble(out_.convolution.points[facets[f].corners[k]]);
      }
      if (IsClearlyApart(corners, window_)) continue;
      facets[kept++] = facets[f];
      out_.origins.push_back(origin);
    }
    facets.resize(kept);
  }

  const BoundingBox& window_;
  WindowConvolution out_;
  FacetCollector collect_{&out_.convolution};
  int source_ = 0;
};

}  // namespace

bool IsClearlyApart(const Vector3d corners[3], const BoundingBox& box) {
  const Vector3d center = box.Center(), half = 0.5 * (box.max - box.min);
  const Vector3d t[3] = {corners[0] - center, corners[1] - center,
                         corners[2] - center};
  const Vector3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
  const Vector3d high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
  const double reach =
      std::max({half.maxCoeff(), -low.minCoeff(), high.maxCoeff()});
  const double slack = kClearShare * reach;
  if (((low - half).array() > slack).any() ||
      ((high + half).array() < -slack).any()) {
    return true;
  }
  const Vector3d edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  const Vector3d n = edges[0].cross(edges[1]);
  if (std::abs(n.dot(t[0])) > n.cwiseAbs().dot(half) + slack * n.lpNorm<1>()) {
    return true;
  }
  // The axis e × unit(k) has two components; both ends of e look alike along
  // it.
  for (int i = 0; i < 3; ++i) {
    const Vector3d &e = edges[i], &a = t[i], &b = t[(i + 2) % 3];
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      const double p = e[v] * a[u] - e[u] * a[v];
      const double q = e[v] * b[u] - e[u] * b[v];
      const double room = std::abs(e[v]) * (half[u] + slack) +
                          std::abs(e[u]) * (half[v] + slack);
      if (std::min(p, q) > room || std::max(p, q) < -room) return true;
    }
  }
  return false;
}

FeatureSums::Operand::Operand(const GridSolid& s, int turn)
    : solid(s),
      stars(s),
      edges(ConvexEdges(s)),
      vertices(VertexTree(s)),
      facets(FacetTree(s)),
      arcs(ArcTree(s, edges)) {
  touching.reserve(s.normals.size());
  for (const GridNormal& n : s.normals) touching.emplace_back(n, turn);
}

FeatureSums::FeatureSums(const GridSolid& p, const GridSolid& q)
    : p_(p, 1), q_(q, -1) {
  const BoxTree::Node& a = p_.facets.tree().nodes()[0];
  const BoxTree::Node& b = q_.facets.tree().nodes()[0];
  bounds_ = {a.min + b.min, a.max + b.max};
}

WindowConvolution FeatureSums::Within(const BoundingBox& window) const {
  return *Within(window, std::numeric_limits<std::size_t>::max());
}

std::optional<WindowConvolution> FeatureSums::Within(const BoundingBox& window,
                                                     std::size_t most) const {
  WindowSums sums(window, most);
  if (!sums.FindSums(p_, q_)) return std::nullopt;
  sums.SortSums();
  WindowFacets out(window);
  for (const auto& [f, v, none] : sums.facets_of_p()) {
    out.AddFacet(p_.solid, f, q_.solid.vertices[v], ContactKind::kObstacleFacet,
                 {f, v});
  }
  for (const auto& [f, v, none] : sums.facets_of_q()) {
    out.AddFacet(q_.solid, f, p_.solid.vertices[v], ContactKind::kRobotFacet,
                 {v, f});
  }
  for (const auto& [e, g, side] : sums.edges()) {
    out.AddEdges(p_.solid, p_.edges[e], q_.solid, q_.edges[g], side, {e, g});
  }
  return out.TakeFacets();
}

}  // namespace phongpd::internal
