// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/touching_features.h"

namespace phongpd::internal {

// Numbers distinct keys, triples of integers, 0, 1, ... as they come: a table
// of numbers, twice as long as there are keys at least, searched from each
// key's place on.
template <typename Key, typename Hash>
class KeyNumbers {
 public:
  // The number of `key` among `keys`, which are those numbered so far; where it
  // is none of them that it gets, keys->size(), and is appended.
  int Number(const Key& key, std::vector<Key>* keys) {
    if (2 * (keys->size() + 1) > slots_.size()) Grow(*keys);
    std::size_t at = Hash()(key) & (slots_.size() - 1);
    for (; slots_[at] >= 0; at = (at + 1) & (slots_.size() - 1)) {
      if (IsEqual((*keys)[static_cast<std::size_t>(slots_[at])], key)) {
        return slots_[at];
      }
    }
    slots_[at] = static_cast<int>(keys->size());
    keys->push_back(key);
    return slots_[at];
  }

 private:
  // A call of memcmp costs more than three comparisons.
  static bool IsEqual(const Key& a, const Key& b) {
    return ((a[0] ^ b[0]) | (a[1] ^ b[1]) | (a[2] ^ b[2])) == 0;
  }

  void Grow(const std::vector<Key>& keys) {
    slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), -1);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      std::size_t at = Hash()(keys[i]) & (slots_.size() - 1);
      while (slots_[at] >= 0) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = static_cast<int>(i);
    }
  }

  std::vector<int> slots_;  // a power of two of them; −1: free
};

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
    return point_numbers_.Number(sum, &out_->points);
  }
  void Add(const Triangle& t, const GridNormal& n, ContactKind kind,
           int source) {
    Triangle first = t;
    std::rotate(first.begin(), std::min_element(first.begin(), first.end()),
                first.end());
    const auto next = static_cast<int>(seen_.size());
    if (seen_numbers_.Number(first, &seen_) != next) return;
    out_->facets.push_back({t, n, source, kind});
  }

  Convolution* out_;
  KeyNumbers<GridPoint, GridPointHash> point_numbers_;
  KeyNumbers<Triangle, TriangleHash> seen_numbers_;
  std::vector<Triangle> seen_;
};

}  // namespace phongpd::internal
