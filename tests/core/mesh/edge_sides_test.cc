// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/edge_sides.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <utility>
#include <vector>

namespace phongpd::internal {
namespace {

using Ends = std::pair<int, int>;

// The other route: a map from edges to their triangles.
std::map<Ends, std::vector<Ends>> SidesByMap(
    const std::vector<Triangle>& triangles, FoldedTriangles folded) {
  std::map<Ends, std::vector<Ends>> sides;  // triangle and corner
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    if (folded == FoldedTriangles::kLeftOut && UsesVertexTwice(triangles[t])) {
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides[std::minmax(a, b)].emplace_back(t, k);
    }
  }
  return sides;
}

// Of soups with edges of any number of triangles, folded ones, and vertices
// that nothing uses.
TEST(EdgeSides, AreThoseOfAMapInItsOrder) {
  std::mt19937 random(1);
  for (const int vertices : {1, 2, 5, 40, 5000}) {
    std::uniform_int_distribution<int> index(0, vertices - 1);
    std::vector<Triangle> triangles(300);
    for (Triangle& t : triangles) {
      for (int& v : t) v = index(random);
    }
    for (const auto folded :
         {FoldedTriangles::kKept, FoldedTriangles::kLeftOut}) {
      const auto expected = SidesByMap(triangles, folded);
      const std::vector<EdgeSide> sides = SortedEdgeSides(triangles, folded);
      auto edge = expected.begin();
      ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
        ASSERT_NE(edge, expected.end());
        std::vector<Ends> found;
        for (std::size_t i = begin; i < end; ++i) {
          const EdgeSide& side = sides[i];
          EXPECT_EQ(Ends(side.low, side.high), edge->first);
          EXPECT_EQ(side.is_forward,
                    triangles[side.triangle][side.corner] == side.low &&
                        side.low != side.high);
          found.emplace_back(side.triangle, side.corner);
        }
        EXPECT_EQ(found, edge->second);
        ++edge;
      });
      EXPECT_EQ(edge, expected.end());
    }
  }
  EXPECT_TRUE(SortedEdgeSides({}, FoldedTriangles::kKept).empty());
}

// A fan: all edges at one vertex, as in a cone of many sides.
TEST(EdgeSides, OfAVertexOfHighValence) {
  constexpr int kSides = 100000;
  std::vector<Triangle> fan;
  for (int i = 0; i < kSides; ++i) {
    fan.push_back({0, 1 + i, 1 + (i + 1) % kSides});
  }
  std::size_t pairs = 0, open = 0;
  const auto sides = SortedEdgeSides(fan, FoldedTriangles::kKept);
  ForEachEdge(sides, [&](std::size_t begin, std::size_t end) {
    pairs += end - begin == 2;
    open += end - begin == 1;
  });
  EXPECT_EQ(pairs, kSides);
  EXPECT_EQ(open, kSides);
}

}  // namespace
}  // namespace phongpd::internal
