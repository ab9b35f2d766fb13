// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "core/minkowski/convolution.h"
#include "core/minkowski/touching_features.h"

namespace phongpd::internal {

// Collects facets over shared, distinct points; a triangle generated twice
// (several contacts at one place) is kept once.
class FacetCollector {
 public:
  explicit FacetCollector(Convolution* out) : out_(out) {}

  // Facet f of a solid, moved to a vertex of the other.
  void AddFacet(const GridSolid& solid, int f, const GridPoint& vertex,
                ContactKind kind, int source) {
    Triangle t;
    for (int k = 0; k < 3; ++k) {
      t[k] = Point(solid.vertices[solid.facets[f][k]] + vertex);
    }
    Add(t, solid.normals[f], kind, source);
  }

  // The parallelogram of edge e of P and g of Q; `side` is CommonSide's, not 0.
  void AddEdges(const GridSolid& p, const ConvexEdge& e, const GridSolid& q,
                const ConvexEdge& g, int side, int source) {
    GridNormal n = Cross(e.exact[0], g.exact[0]);
    const int c0 = Point(p.vertices[e.a] + q.vertices[g.a]);
    int c1 = Point(p.vertices[e.b] + q.vertices[g.a]);
    const int c2 = Point(p.vertices[e.b] + q.vertices[g.b]);
    int c3 = Point(p.vertices[e.a] + q.vertices[g.b]);
    if (side > 0) {  // outward is away from the apices
      n = Negated(n);
      std::swap(c1, c3);
    }
    Add({c0, c1, c2}, n, ContactKind::kEdges, source);
    Add({c0, c2, c3}, n, ContactKind::kEdges, source);
  }

 private:
  struct TriangleHash {
    std::size_t operator()(const Triangle& t) const {
      return GridPointHash()({t[0], t[1], t[2]});
    }
  };

  int Point(const GridPoint& sum) {
    const auto [it, is_new] =
        ids_.emplace(sum, static_cast<int>(out_->points.size()));
    if (is_new) out_->points.push_back(sum);
    return it->second;
  }
  void Add(const Triangle& t, const GridNormal& n, ContactKind kind,
           int source) {
    Triangle first = t;
    std::rotate(first.begin(), std::min_element(first.begin(), first.end()),
                first.end());
    if (!seen_.insert(first).second) return;
    out_->facets.push_back({t, n, source, kind});
  }

  Convolution* out_;
  std::unordered_map<GridPoint, int, GridPointHash> ids_;
  std::unordered_set<Triangle, TriangleHash> seen_;
};

}  // namespace phongpd::internal
