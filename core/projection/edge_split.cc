// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/edge_split.h"

#include <algorithm>
#include <cstddef>

#include "core/mesh/edge_sides.h"
#include "core/mesh/numbers.h"

namespace phongpd {
namespace {

using internal::At;

// Cuts one triangle along its marked edges, longest first.
class TriangleCutter {
 public:
  TriangleCutter(const TriangleMesh& mesh, std::vector<Triangle>* out)
      : mesh_(mesh), out_(out) {}

  // `middle[k]` is the new vertex on edge k, or -1.
  void Cut(const Triangle& t, const std::array<int, 3>& middle) {
    int longest = -1;
    for (int k = 0; k < 3; ++k) {
      if (middle[At(k)] < 0) continue;
      if (longest < 0 || Longer(t, k, longest)) longest = k;
    }
    if (longest < 0) {
      out_->push_back(t);
      return;
    }
    const int k1 = (longest + 1) % 3;
    const int k2 = (longest + 2) % 3;
    const int a = t[At(longest)];
    const int b = t[At(k1)];
    const int c = t[At(k2)];
    const int m = middle[At(longest)];
    Cut({a, m, c}, {-1, -1, middle[At(k2)]});
    Cut({m, b, c}, {-1, middle[At(k1)], -1});
  }

 private:
  bool Longer(const Triangle& t, int k, int than) const {
    const auto key = [&](int side) {
      const int i = t[At(side)];
      const int j = t[At((side + 1) % 3)];
      return std::make_pair(
          -(mesh_.vertices[At(i)] - mesh_.vertices[At(j)]).squaredNorm(),
          std::make_pair(std::min(i, j), std::max(i, j)));
    };
    return key(k) < key(than);
  }

  const TriangleMesh& mesh_;
  std::vector<Triangle>* out_;
};

}  // namespace

EdgeTable MakeEdgeTable(const std::vector<Triangle>& triangles,
                        std::size_t* bad_edges) {
  using internal::EdgeSide;
  const std::vector<EdgeSide> sides =
      internal::SortedEdgeSides(triangles, internal::FoldedTriangles::kKept);
  EdgeTable table;
  table.vertices.reserve(sides.size() / 2);
  table.triangles.reserve(sides.size() / 2);
  table.triangle_edges.assign(triangles.size(), {-1, -1, -1});
  *bad_edges = 0;
  internal::ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    const EdgeSide& first = sides[begin];
    if (end - begin != 2 || first.is_forward == sides[begin + 1].is_forward ||
        first.low == first.high) {
      ++*bad_edges;
      return;
    }
    const int id = static_cast<int>(table.vertices.size());
    table.vertices.push_back({first.low, first.high});
    table.triangles.push_back({first.triangle, sides[begin + 1].triangle});
    for (std::size_t h = begin; h < end; ++h) {
      table.triangle_edges[At(sides[h].triangle)][At(sides[h].corner)] = id;
    }
  });
  return table;
}

std::vector<int> SplitEdges(const EdgeTable& edges,
                            const std::vector<char>& marked, TriangleMesh* mesh,
                            std::vector<int>* source) {
  std::vector<int> middle(edges.vertices.size(), -1);
  for (std::size_t e = 0; e < edges.vertices.size(); ++e) {
    if (!marked[e]) continue;
    middle[e] = static_cast<int>(mesh->vertices.size());
    const auto& [i, j] = edges.vertices[e];
    mesh->vertices.push_back(0.5 *
                             (mesh->vertices[At(i)] + mesh->vertices[At(j)]));
  }
  std::vector<Triangle> triangles;
  std::vector<int> sources;
  triangles.reserve(mesh->triangles.size());
  sources.reserve(mesh->triangles.size());
  TriangleCutter cutter(*mesh, &triangles);
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
    const auto& side = edges.triangle_edges[t];
    cutter.Cut(mesh->triangles[t],
               {middle[At(side[0])], middle[At(side[1])], middle[At(side[2])]});
    sources.resize(triangles.size(), (*source)[t]);
  }
  mesh->triangles = std::move(triangles);
  *source = std::move(sources);
  return middle;
}

}  // namespace phongpd
