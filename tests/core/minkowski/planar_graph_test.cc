// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: which polygons contain the points just left of a half-edge, and how
// often segments cross, in unbounded rationals.
#include "core/minkowski/arrangement/planar_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "core/mesh/union_find.h"
#include "tests/support/rationals.h"

namespace phongpd {
namespace {

using internal::Coverage;
using internal::GridPlane;
using internal::GridPoint;
using internal::PlanarGraph;
using testing::Rational;
using testing::RationalPoint;

// A plane with a basis of its lattice: normal = e1 × e2, so that triangles run
// counter-clockwise along the normal where they do in coordinates (i, j).
struct Sheet {
  GridPoint origin, e1, e2;

  GridPoint At(std::int64_t i, std::int64_t j) const {
    GridPoint p = origin;
    for (std::size_t k = 0; k < 3; ++k) p[k] += i * e1[k] + j * e2[k];
    return p;
  }
  GridPlane Plane() const {
    const internal::GridNormal n = internal::Cross(e1, e2);
    return {n, internal::Dot(n, origin)};
  }
};

// Seen along and against the projection, and tilted, with the largest
// component of the normal in every place.
const Sheet kSheets[] = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},   {{7, -3, 2}, {0, 1, 0}, {1, 0, 0}},
    {{5, 5, 5}, {2, -1, 0}, {3, 0, -1}}, {{0, 1, 2}, {3, 0, -1}, {2, -1, 0}},
    {{-9, 4, 0}, {1, 3, -2}, {0, 1, 5}}, {{1, 1, 1}, {0, 1, 5}, {1, 3, -2}},
    {{0, 0, 3}, {-4, 1, 1}, {1, 0, 1}},
};

// Convex.
struct Polygon {
  std::vector<GridPoint> corners;
  int layer;
};

RationalPoint Minus(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalPoint CrossOf(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

Rational DotOf(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// What is built, and what it must agree with.
class Scene {
 public:
  explicit Scene(const Sheet& sheet)
      : sheet_(sheet), graph_(sheet.Plane()), normal_() {
    for (std::size_t k = 0; k < 3; ++k) {
      normal_[k] = testing::ToRational(sheet.Plane().normal[k]);
    }
  }

  // The border of a convex polygon, counter-clockwise along the normal.
  void AddPolygon(const std::vector<GridPoint>& corners, int layer) {
    polygons_.push_back({corners, layer});
    Coverage net{};
    net[static_cast<std::size_t>(layer)] = 1;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      AddSegment(corners[k], corners[(k + 1) % corners.size()], net);
    }
  }
  void AddSegment(const GridPoint& a, const GridPoint& b,
                  const Coverage& net = {}) {
    const int from = Vertex(a), to = Vertex(b);
    graph_.AddSegment(from, to, graph_.CutterAlong(a, b), net);
  }
  void AddPoint(const GridPoint& p) {
    const int v = Vertex(p);
    graph_.AddSegment(v, v, sheet_.Plane(), {});
  }

  // Builds, and looks at every half-edge and face.
  void BuildAndCheck() {
    graph_.Build();
    for (const internal::LocatedPoint& v : graph_.vertices()) {
      at_.push_back(testing::ToRational(v.definition));
      EXPECT_EQ(testing::Height(sheet_.Plane(), at_.back()), 0);
    }
    EXPECT_EQ(std::set<RationalPoint>(at_.begin(), at_.end()).size(),
              at_.size());
    half_edges_ = 0;
    for (std::size_t f = 0; f < graph_.faces().size(); ++f) CheckFace(f);
    CheckEuler();
  }

  const PlanarGraph& graph() const { return graph_; }
  int half_edges() const { return half_edges_; }

 private:
  int Vertex(const GridPoint& p) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i] == p) return static_cast<int>(i);
    }
    points_.push_back(p);
    internal::PointDefinition d;
    d.a = p;
    return graph_.AddVertex(internal::Locate(d));
  }

  // How many polygons contain m + ε·left for all small ε > 0.
  Coverage CountBeside(const RationalPoint& m, const RationalPoint& left) {
    Coverage count{};
    for (const Polygon& t : polygons_) {
      const std::size_t size = t.corners.size();
      bool inside = true;
      for (std::size_t k = 0; k < size && inside; ++k) {
        const RationalPoint a = testing::ToRational(t.corners[k]);
        const RationalPoint b = testing::ToRational(t.corners[(k + 1) % size]);
        const RationalPoint inwards = CrossOf(normal_, Minus(b, a));
        Rational side = DotOf(inwards, Minus(m, a));
        if (side == 0) side = DotOf(inwards, left);
        inside = side > 0;
      }
      if (inside) ++count[static_cast<std::size_t>(t.layer)];
    }
    return count;
  }

  void CheckFace(std::size_t f) {
    const PlanarGraph::Face& face = graph_.faces()[f];
    for (const int first : face.loops) {
      int h = first;
      do {
        ++half_edges_;
        EXPECT_TRUE(seen_.insert(h).second) << "half-edge of two faces";
        const auto from = static_cast<std::size_t>(graph_.From(h));
        const auto to = static_cast<std::size_t>(graph_.From(h ^ 1));
        EXPECT_EQ(graph_.From(graph_.Next(h)), graph_.From(h ^ 1));
        RationalPoint middle,
            left = CrossOf(normal_, Minus(at_[to], at_[from]));
        for (std::size_t k = 0; k < 3; ++k) {
          middle[k] = (at_[from][k] + at_[to][k]) / 2;
          if (graph_.IsMirrored()) left[k] = 0 - left[k];
        }
        EXPECT_EQ(CountBeside(middle, left), face.coverage);
        h = graph_.Next(h);
      } while (h != first);
    }
    if (f == 0) {
      EXPECT_EQ(face.coverage, Coverage{});
    }
  }

  // V − E + F = 1 + C for every planar graph.
  void CheckEuler() {
    internal::UnionFind sets(at_.size());
    std::set<int> used, components;
    int edges = 0;
    for (const int h : seen_) {
      EXPECT_EQ(seen_.count(h ^ 1), 1U);
      sets.Join(graph_.From(h), graph_.From(h ^ 1));
      used.insert(graph_.From(h));
      edges += h % 2;
    }
    for (const int v : used) components.insert(sets.Find(v));
    EXPECT_EQ(static_cast<int>(used.size()) - edges +
                  static_cast<int>(graph_.faces().size()),
              1 + static_cast<int>(components.size()));
  }

  const Sheet& sheet_;
  PlanarGraph graph_;
  RationalPoint normal_;
  std::vector<Polygon> polygons_;
  std::vector<GridPoint> points_;
  std::vector<RationalPoint> at_;
  std::set<int> seen_;
  int half_edges_ = 0;
};

int Deepest(const PlanarGraph& graph) {
  int most = 0;
  for (const PlanarGraph::Face& face : graph.faces()) {
    most = std::max(most, face.coverage[0]);
  }
  return most;
}

TEST(PlanarGraph, CountsTheTrianglesLeftOfEveryHalfEdge) {
  std::mt19937_64 random(3);
  int half_edges = 0, crossings = 0;
  for (const Sheet& sheet : kSheets) {
    // Few places, so that corners, edges and lines fall together; then many.
    for (const std::int64_t range :
         {std::int64_t{5}, std::int64_t{12}, std::int64_t{1} << 34}) {
      for (int round = 0; round < 4; ++round) {
        Scene scene(sheet);
        std::uniform_int_distribution<std::int64_t> x(0, range);
        std::size_t points = 0;
        for (int i = 0; i < 6; ++i) {
          const std::int64_t a = x(random), b = x(random), c = x(random),
                             d = x(random), e = x(random), f = x(random);
          const auto turn = internal::Int128(c - a) * (f - b) -
                            internal::Int128(d - b) * (e - a);
          if (turn == 0) continue;
          std::vector<GridPoint> corners = {sheet.At(a, b), sheet.At(c, d),
                                            sheet.At(e, f)};
          if (turn < 0) std::swap(corners[1], corners[2]);
          scene.AddPolygon(corners, i % 2);
        }
        points = scene.graph().vertices().size();
        scene.BuildAndCheck();
        crossings += static_cast<int>(scene.graph().vertices().size() - points);
        half_edges += scene.half_edges();
      }
    }
  }
  EXPECT_GT(half_edges, 3000);
  EXPECT_GT(crossings, 500);
}

// Squares within squares, beside squares: every border loop belongs to the face
// around it, whatever lies left of it.
TEST(PlanarGraph, PutsIslandsIntoTheFaceAroundThem) {
  for (const Sheet& sheet : kSheets) {
    Scene scene(sheet);
    const auto add = [&](std::int64_t i, std::int64_t j, std::int64_t size) {
      scene.AddPolygon({sheet.At(i, j), sheet.At(i + size, j),
                        sheet.At(i + size, j + size), sheet.At(i, j + size)},
                       0);
    };
    add(0, 0, 100);
    for (std::int64_t depth = 1; depth < 6; ++depth) {
      add(10 * depth, 10 * depth - 3, 95 - 18 * depth);
    }
    add(2, 2, 3);
    add(2, 90, 4);
    add(200, 20, 7);
    scene.BuildAndCheck();
    // One each, and the outside; a border each, and as an island.
    EXPECT_EQ(scene.graph().faces().size(), 1U + 9U);
    EXPECT_EQ(scene.graph().faces()[0].loops.size(), 2U);
    std::size_t loops = 0;
    for (const PlanarGraph::Face& face : scene.graph().faces()) {
      loops += face.loops.size();
    }
    EXPECT_EQ(loops, 2U * 9U);
    EXPECT_EQ(Deepest(scene.graph()), 6);
  }
}

// Three lines through one place that is on no grid point, found thrice.
TEST(PlanarGraph, HasOneVertexWhereManySegmentsCross) {
  for (const Sheet& sheet : kSheets) {
    Scene scene(sheet);
    // All through (7/3, 7/3).
    scene.AddSegment(sheet.At(0, 0), sheet.At(7, 7));
    scene.AddSegment(sheet.At(0, 7), sheet.At(7, -7));
    scene.AddSegment(sheet.At(7, 0), sheet.At(-7, 7));
    scene.BuildAndCheck();
    EXPECT_EQ(scene.graph().vertices().size(), 7U);
    EXPECT_EQ(scene.graph().faces().size(), 1U);
    EXPECT_EQ(scene.half_edges(), 12);
  }
}

TEST(PlanarGraph, SplitsSegmentsAtPointsAndWhereTheyOverlap) {
  for (const Sheet& sheet : kSheets) {
    Scene scene(sheet);
    scene.AddSegment(sheet.At(0, 0), sheet.At(10, 10));
    scene.AddSegment(sheet.At(8, 8), sheet.At(2, 2));
    scene.AddSegment(sheet.At(6, 6), sheet.At(20, 20));
    scene.AddPoint(sheet.At(5, 5));
    scene.AddPoint(sheet.At(5, 6));  // on nothing
    scene.BuildAndCheck();
    // 0, 2, 5, 6, 8, 10, 20 in a row.
    EXPECT_EQ(scene.half_edges(), 2 * 6);
    EXPECT_EQ(scene.graph().faces().size(), 1U);
  }
}

// Directions closer than doubles tell leave a vertex in the right order: a fan
// of needles, each counted where it is.
TEST(PlanarGraph, SortsDirectionsExactly) {
  const std::int64_t n = std::int64_t{1} << 34;
  for (const Sheet& sheet : kSheets) {
    Scene scene(sheet);
    for (int i = 0; i < 4; ++i) {
      scene.AddPolygon({sheet.At(0, 0), sheet.At(n - i, i), sheet.At(n, i + 2)},
                       i % 2);
    }
    scene.BuildAndCheck();
    EXPECT_GT(scene.graph().faces().size(), 4U);
  }
}

}  // namespace
}  // namespace phongpd
