// SPDX-License-Identifier: GPL-3.0-or-later
// Ties between parallel features against a turn that is really made: about the
// same axis, by a rational rotation of angle 2^-999, in exact integers.
#include "core/minkowski/convolution/symbolic_turn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <random>
#include <set>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/grid_solid.h"
#include "problems/shapes/random_solids.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Vector = std::array<Integer, 3>;

template <typename T>
Vector ToVector(const std::array<T, 3>& v) {
  return {Integer(v[0]), Integer(v[1]), Integer(v[2])};
}
Vector Product(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
Integer Inner(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// v turned by the unit quaternion along 1 + δω, δ = 2^-1000, times a positive
// number: (1 − δ²ω²) v + 2δ ω × v + 2δ² (ω·v) ω.
Vector Turned(const Vector& v) {
  const Vector axis = {1, Integer(1) << 122, Integer(1) << 244};
  const Integer inverse = Integer(1) << 1000;
  const Integer keep = inverse * inverse - Inner(axis, axis);
  const Vector across = Product(axis, v);
  const Integer along = 2 * Inner(axis, v);
  Vector out;
  for (int k = 0; k < 3; ++k) {
    out[k] = keep * v[k] + 2 * inverse * across[k] + along * axis[k];
  }
  return out;
}

GridPoint RandomVector(int bits, std::mt19937_64* random) {
  const std::int64_t most = std::int64_t{1} << bits;
  std::uniform_int_distribution<std::int64_t> uniform(-most, most);
  return {uniform(*random), uniform(*random), uniform(*random)};
}

TEST(SymbolicTurn, DecidesTiesAsARealTurnDoes) {
  std::mt19937_64 random(1);
  int ties = 0;
  for (int i = 0; i < 20000; ++i) {
    const int bits = 1 + i % 39;
    GridPoint d = RandomVector(bits, &random);
    GridPoint other = RandomVector(1 + i % 7 * 6, &random);
    if (i % 3 == 0) d[2] = other[2] = 0;  // terms that vanish
    if (i % 5 == 0) d[1] = other[1] = 0;
    const GridNormal n = Cross(d, other);
    if (IsZero(n) || d == GridPoint{0, 0, 0}) continue;
    ++ties;
    ASSERT_TRUE(Dot(n, d) == 0);
    EXPECT_EQ(TurnedSign(n, d), Inner(ToVector(n), Turned(ToVector(d))).sign());
    EXPECT_EQ(-TurnedSign(n, d),
              Inner(Turned(ToVector(n)), ToVector(d)).sign());
  }
  EXPECT_GT(ties, 10000);
}

// The largest that may come: no product overflows.
TEST(SymbolicTurn, HoldsForTheLongestVectors) {
  const std::int64_t most = (std::int64_t{1} << (kGridBits + 1)) - 1;
  for (int signs = 0; signs < 64; ++signs) {
    GridPoint d, other;
    for (int k = 0; k < 3; ++k) {
      d[k] = (signs >> k & 1) != 0 ? most : -most;
      other[k] = (signs >> (3 + k) & 1) != 0 ? most - k : k - most;
    }
    const GridNormal n = Cross(d, other);
    if (IsZero(n)) continue;
    EXPECT_EQ(TurnedSign(n, d), Inner(ToVector(n), Turned(ToVector(d))).sign());
  }
}

using GridCorners = std::array<GridPoint, 3>;

// The same orientation always begins with the least corner.
GridCorners Canonical(GridCorners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return c;
}

std::set<GridCorners> Facets(const GridSolid& p, const GridSolid& q) {
  std::set<GridCorners> found;
  const Convolution convolution = ReducedConvolution(p, q);
  for (const ConvolutionFacet& f : convolution.facets) {
    const auto at = [&](int k) { return convolution.points[f.corners[k]]; };
    found.insert(Canonical({at(0), at(1), at(2)}));
  }
  return found;
}

// By the definition, of P and the turned Q.
std::set<GridCorners> FacetsByBruteForce(const GridSolid& p,
                                         const GridSolid& q) {
  std::set<GridCorners> found;
  const auto add_facets = [&](const GridSolid& facets, const GridSolid& others,
                              bool others_turn) {
    for (std::size_t f = 0; f < facets.facets.size(); ++f) {
      Vector n = ToVector(facets.normals[f]);
      if (!others_turn) n = Turned(n);
      for (std::size_t v = 0; v < others.vertices.size(); ++v) {
        const auto& star = others.neighbors[v];
        const bool touches =
            !star.empty() && std::all_of(star.begin(), star.end(), [&](int w) {
              Vector d = ToVector(others.vertices[w] - others.vertices[v]);
              if (others_turn) d = Turned(d);
              return Inner(n, d) < 0;
            });
        if (!touches) continue;
        const auto at = [&](int k) {
          return facets.vertices[facets.facets[f][k]] + others.vertices[v];
        };
        found.insert(Canonical({at(0), at(1), at(2)}));
      }
    }
  };
  add_facets(p, q, true);
  add_facets(q, p, false);
  struct Edge {
    GridPoint a, b;
    Vector along, left, right;
  };
  const auto convex_edges = [](const GridSolid& s, bool turn) {
    std::vector<Edge> edges;
    for (const GridEdge& e : s.edges) {
      const GridPoint& a = s.vertices[e.a];
      const GridPoint right = s.vertices[e.right_apex] - a;
      if (Dot(s.normals[e.left], right) >= 0) continue;
      Edge edge{a, s.vertices[e.b], ToVector(s.vertices[e.b] - a),
                ToVector(s.vertices[e.left_apex] - a), ToVector(right)};
      for (Vector* v : {&edge.along, &edge.left, &edge.right}) {
        if (turn) *v = Turned(*v);
      }
      edges.push_back(edge);
    }
    return edges;
  };
  for (const Edge& e : convex_edges(p, false)) {
    for (const Edge& g : convex_edges(q, true)) {
      if (IsZero(Cross(e.b - e.a, g.b - g.a))) continue;  // no area
      const Vector n = Product(e.along, g.along);
      const int side = Inner(n, e.left).sign();
      EXPECT_NE(side, 0);
      if (Inner(n, e.right).sign() != side || Inner(n, g.left).sign() != side ||
          Inner(n, g.right).sign() != side) {
        continue;
      }
      GridPoint c[4] = {e.a + g.a, e.b + g.a, e.b + g.b, e.a + g.b};
      if (side > 0) std::swap(c[1], c[3]);
      found.insert(Canonical({c[0], c[1], c[2]}));
      found.insert(Canonical({c[0], c[2], c[3]}));
    }
  }
  return found;
}

// A voxel solid under an integer matrix, coordinates below 2^37: facets and
// edges of both operands are parallel in plenty.
GridSolid MappedVoxels(const std::array<GridPoint, 3>& columns, bool reflect,
                       std::mt19937_64* random) {
  TriangleMesh mesh = testing::RandomVoxelSolid(2, 0.6, random);
  std::vector<GridPoint> points;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    GridPoint p = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < 3; ++i) p[i] += columns[k][i] * std::llround(v[k]);
    }
    points.push_back(p);
  }
  if (Dot(Cross(columns[0], columns[1]), columns[2]) < 0) {
    mesh = Reversed(mesh);
  }
  return MakeGridSolid(points, mesh.triangles, reflect, "voxels");
}

TEST(SymbolicTurn, ConvolutionOfParallelSolidsIsThatOfTurnedOnes) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 11; ++i) {
    SCOPED_TRACE(i);
    std::array<GridPoint, 3> columns;
    do {
      for (GridPoint& c : columns) c = RandomVector(1 + 3 * i, &random);
    } while (Dot(Cross(columns[0], columns[1]), columns[2]) == 0);
    const GridSolid p = MappedVoxels(columns, false, &random);
    const GridSolid q = MappedVoxels(columns, true, &random);
    EXPECT_EQ(Facets(p, q), FacetsByBruteForce(p, q));
  }
}

}  // namespace
}  // namespace phongpd::internal
