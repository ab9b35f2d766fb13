// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/edge_sides.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/mesh/numbers.h"

namespace phongpd::internal {
namespace {

// Calls visit(side) for all of them, triangle by triangle.
template <typename Visit>
void ForEachSide(const std::vector<Triangle>& triangles, FoldedTriangles folded,
                 const Visit& visit) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (folded == FoldedTriangles::kLeftOut && UsesVertexTwice(triangles[t])) {
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const int from = triangles[t][At(k)], to = triangles[t][At((k + 1) % 3)];
      visit(EdgeSide{std::min(from, to), std::max(from, to),
                     static_cast<int>(t), k, from < to});
    }
  }
}

}  // namespace

bool UsesVertexTwice(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::vector<EdgeSide> SortedEdgeSides(const std::vector<Triangle>& triangles,
                                      FoldedTriangles folded) {
  // Counted by the lower end; the few at one vertex are sorted then.  No hash
  // table: no bad case for vertices of high valence.
  int last = -1;
  for (const Triangle& t : triangles) {
    last = std::max(last, *std::max_element(t.begin(), t.end()));
  }
  std::vector<std::size_t> place(At(last + 1) + 1, 0);
  ForEachSide(triangles, folded,
              [&](const EdgeSide& side) { ++place[At(side.low) + 1]; });
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<EdgeSide> sides(place.back());
  ForEachSide(triangles, folded, [&](const EdgeSide& side) {
    sides[place[At(side.low)]++] = side;
  });
  // place[v] is the end of the sides at v now.
  std::size_t begin = 0;
  for (const std::size_t end : place) {
    std::sort(sides.data() + begin, sides.data() + end,
              [](const EdgeSide& a, const EdgeSide& b) {
                return std::tie(a.high, a.triangle, a.corner) <
                       std::tie(b.high, b.triangle, b.corner);
              });
    begin = end;
  }
  return sides;
}

}  // namespace phongpd::internal
