// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/contact_space/surface_assembly.h"

#include <map>
#include <set>
#include <stdexcept>

#include "core/contact_space/union_find.h"

namespace phongpd::internal {
namespace {

// Triangles with their neighbour across each edge k = (corner k, k + 1).
struct Sheets {
  std::vector<Triangle> corners;
  std::vector<std::array<int, 3>> mates;
};

int FindCorner(const Triangle& t, int vertex) {
  for (int k = 0; k < 3; ++k) {
    if (t[k] == vertex) return k;
  }
  throw std::logic_error("contact space: ring facet without its edge");
}

// The edge of `t` between two of its corners, whichever way it runs.
int FindEdge(const Triangle& t, int a, int b) {
  const int k = FindCorner(t, a);
  return t[(k + 1) % 3] == b ? k : FindCorner(t, b);
}

// Pairs triangles across the occupied sectors of every ring.
Sheets PairTriangles(const EdgeRings& rings, std::vector<Triangle> corners,
                     const std::vector<int>& triangle_of) {
  Sheets sheets{std::move(corners), {}};
  sheets.mates.assign(sheets.corners.size(), {-1, -1, -1});
  for (const EdgeRing& ring : rings.rings) {
    const int size = ring.end - ring.begin;
    const auto facet = [&](int k) -> const RingFacet& {
      return rings.facets[ring.begin + k % size];
    };
    for (int k = 0; k < size; ++k) {
      // A triangle that is free towards its predecessor opens an occupied
      // sector; the next triangle free towards its successor closes it.
      const int open = triangle_of[facet(k).SideToPrevious()];
      if (open < 0) continue;
      int closing = -1;
      for (int j = k + 1; closing < 0 && j <= k + size; ++j) {
        closing = triangle_of[facet(j).SideToNext()];
      }
      if (closing < 0) {
        throw std::logic_error("contact space: surface is not closed");
      }
      const auto edge = [&](int t) {
        return FindEdge(sheets.corners[t], ring.low, ring.high);
      };
      sheets.mates[open][edge(open)] = closing;
      sheets.mates[closing][edge(closing)] = open;
    }
  }
  return sheets;
}

// Gives every fan of triangles around a corner a vertex of its own.
void NumberVertices(Sheets* sheets, ExactSurface* out) {
  const std::size_t count = sheets->corners.size();
  UnionFind fans(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int mate = sheets->mates[t][k];
      for (const int corner : {k, (k + 1) % 3}) {
        const int other =
            FindCorner(sheets->corners[mate], sheets->corners[t][corner]);
        fans.Join(static_cast<int>(3 * t) + corner, 3 * mate + other);
      }
    }
  }
  std::vector<int> vertex_of(3 * count, -1);
  for (std::size_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      int& vertex = vertex_of[fans.Find(static_cast<int>(3 * t) + k)];
      if (vertex < 0) {
        vertex = static_cast<int>(out->vertex_points.size());
        out->vertex_points.push_back(sheets->corners[t][k]);
      }
    }
  }
  for (std::size_t t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      sheets->corners[t][k] = vertex_of[fans.Find(static_cast<int>(3 * t) + k)];
    }
  }
  out->pinned.assign(out->vertex_points.size(), 0);
}

// Splits the sheet edge a→b between t = (a,b,c) and u = (b,a,d) at m.
void SplitEdge(Sheets* sheets, std::vector<int>* facet, int t, int a, int b,
               int m) {
  const int u = sheets->mates[t][FindEdge(sheets->corners[t], a, b)];
  const auto split = [&](int triangle, int from, int to) {
    // (from, to, apex) keeps (from, m, apex); the new one is (m, to, apex).
    const int k = FindCorner(sheets->corners[triangle], from);
    const int apex = sheets->corners[triangle][(k + 2) % 3];
    const std::array<int, 3> mates = sheets->mates[triangle];
    const int fresh = static_cast<int>(sheets->corners.size());
    const int outer = mates[(k + 1) % 3];  // across to → apex
    sheets->corners[triangle] = {from, m, apex};
    sheets->mates[triangle] = {-1, fresh, mates[(k + 2) % 3]};
    sheets->corners.push_back({m, to, apex});
    sheets->mates.push_back({-1, outer, triangle});
    facet->push_back((*facet)[triangle]);
    for (int j = 0; j < 3; ++j) {
      if (sheets->mates[outer][j] == triangle &&
          sheets->corners[outer][j] == apex &&
          sheets->corners[outer][(j + 1) % 3] == to) {
        sheets->mates[outer][j] = fresh;
      }
    }
    return fresh;
  };
  const int t_far = split(t, a, b);
  const int u_far = split(u, b, a);
  sheets->mates[t][0] = u_far;
  sheets->mates[u_far][0] = t;
  sheets->mates[u][0] = t_far;
  sheets->mates[t_far][0] = u;
}

// Half-edges that two sheets of one solid share.
void SeparatePinchedEdges(Sheets* sheets, std::vector<int>* facet,
                          ExactSurface* out, ExactPoints* points) {
  std::map<std::pair<int, int>, std::vector<int>> owners;
  for (std::size_t t = 0; t < sheets->corners.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Triangle& c = sheets->corners[t];
      owners[{c[k], c[(k + 1) % 3]}].push_back(static_cast<int>(t));
    }
  }
  std::set<std::pair<int, int>> pinched;  // undirected
  for (const auto& [edge, triangles] : owners) {
    if (triangles.size() > 1)
      pinched.insert(std::minmax(edge.first, edge.second));
  }
  for (const auto& [a, b] : pinched) {
    const int middle = points->Add(CGAL::midpoint(
        (*points)[out->vertex_points[a]], (*points)[out->vertex_points[b]]));
    // Splitting one sheet renumbers the triangles beside it: search anew.
    for (std::size_t t = 0; t < sheets->corners.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const Triangle& c = sheets->corners[t];
        if (c[k] != a || c[(k + 1) % 3] != b) continue;
        const int m = static_cast<int>(out->vertex_points.size());
        out->vertex_points.push_back(middle);
        out->pinned.push_back(1);
        SplitEdge(sheets, facet, static_cast<int>(t), a, b, m);
        break;
      }
    }
    out->pinned[a] = out->pinned[b] = 1;
  }
}

}  // namespace

ExactSurface AssembleSurface(const std::vector<ArrangementFacet>& facets,
                             const EdgeRings& rings, const FreeCells& cells,
                             bool outer_only, ExactPoints* points) {
  ExactSurface out;
  std::vector<Triangle> corners;
  std::vector<int> triangle_of(2 * facets.size(), -1);  // per side
  const std::vector<char>& wanted =
      outer_only ? cells.side_is_outer : cells.side_is_free;
  for (int s = 0; s < static_cast<int>(triangle_of.size()); ++s) {
    if (!wanted[s] || cells.side_is_free[OppositeSide(s)]) continue;
    triangle_of[s] = static_cast<int>(corners.size());
    // Only + sides can be free: behind a facet is occupied.
    corners.push_back(facets[s / 2].corners);
    out.facet.push_back(facets[s / 2].facet);
  }
  Sheets sheets = PairTriangles(rings, std::move(corners), triangle_of);
  NumberVertices(&sheets, &out);
  SeparatePinchedEdges(&sheets, &out.facet, &out, points);
  out.triangles = std::move(sheets.corners);
  return out;
}

}  // namespace phongpd::internal
