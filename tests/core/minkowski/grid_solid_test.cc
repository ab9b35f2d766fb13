// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: integer volumes, and every pair of facets compared corner by corner.
#include "core/minkowski/operands/grid_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

// No namespace of a std::array finds them.
using internal::operator-;

using internal::GridEdge;
using internal::GridPoint;
using internal::GridSolid;
using internal::Int128;

std::vector<GridPoint> Rounded(const TriangleMesh& mesh) {
  std::vector<GridPoint> points;
  for (const Eigen::Vector3d& v : mesh.vertices) {
    points.push_back(
        {std::llround(v[0]), std::llround(v[1]), std::llround(v[2])});
  }
  return points;
}

const GridPoint& At(const GridSolid& s, int v) {
  return s.vertices[static_cast<std::size_t>(v)];
}
const Triangle& Facet(const GridSolid& s, int f) {
  return s.facets[static_cast<std::size_t>(f)];
}

Int128 SixVolumes(const GridSolid& s) {
  Int128 sum = 0;
  for (const Triangle& t : s.facets) {
    sum +=
        internal::Dot(internal::Cross(At(s, t[0]), At(s, t[1])), At(s, t[2]));
  }
  return sum;
}

bool Runs(const Triangle& t, int a, int b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (t[k] == a && t[(k + 1) % 3] == b) return true;
  }
  return false;
}

// All that the header says of any solid.
void ExpectConsistent(const GridSolid& s) {
  ASSERT_EQ(s.normals.size(), s.facets.size());
  EXPECT_EQ(2 * s.edges.size(), 3 * s.facets.size());
  for (std::size_t f = 0; f < s.facets.size(); ++f) {
    const Triangle& t = s.facets[f];
    EXPECT_EQ(s.normals[f], internal::Cross(At(s, t[1]) - At(s, t[0]),
                                            At(s, t[2]) - At(s, t[0])));
    EXPECT_FALSE(internal::IsZero(s.normals[f]));
  }
  std::set<std::pair<int, std::pair<int, int>>> sides;  // each once
  std::set<std::pair<int, int>> joined;
  for (const GridEdge& e : s.edges) {
    EXPECT_TRUE(Runs(Facet(s, e.left), e.a, e.b));
    EXPECT_TRUE(Runs(Facet(s, e.right), e.b, e.a));
    EXPECT_TRUE(Runs(Facet(s, e.left), e.b, e.left_apex));
    EXPECT_TRUE(Runs(Facet(s, e.right), e.a, e.right_apex));
    EXPECT_TRUE(sides.insert({e.left, {e.a, e.b}}).second);
    EXPECT_TRUE(sides.insert({e.right, {e.b, e.a}}).second);
    joined.insert({e.a, e.b});
    joined.insert({e.b, e.a});
  }
  std::size_t neighbors = 0;
  ASSERT_EQ(s.neighbors.size(), s.vertices.size());
  for (std::size_t v = 0; v < s.neighbors.size(); ++v) {
    neighbors += s.neighbors[v].size();
    for (const int w : s.neighbors[v]) {
      EXPECT_EQ(joined.count({static_cast<int>(v), w}), 1U);
    }
  }
  EXPECT_EQ(neighbors, joined.size());
}

// Do both apices lie strictly behind each other's facet?
bool IsConvex(const GridSolid& s, const GridEdge& e) {
  return internal::Dot(s.normals[static_cast<std::size_t>(e.left)],
                       At(s, e.right_apex) - At(s, e.a)) < 0;
}

GridSolid Make(const TriangleMesh& mesh, bool reflect = false) {
  return internal::MakeGridSolid(Rounded(mesh), mesh.triangles, reflect,
                                 "operand");
}

TEST(GridSolid, HasEveryEdgeBetweenItsTwoFacets) {
  for (const TriangleMesh& mesh :
       {MakeBox({-3, -2, -1}, {3, 2, 1}), MakeL(30, 10, 10),
        MakeIcoBall(1000.0, 2), MakeTorus(2000, 600, 12, 8)}) {
    const GridSolid s = Make(mesh);
    ExpectConsistent(s);
    EXPECT_EQ(s.facets.size(), mesh.triangles.size());
  }
}

TEST(GridSolid, ReflectedIsTheSameSolidThroughTheOrigin) {
  const TriangleMesh mesh = MakeL(30, 10, 10);
  const GridSolid s = Make(mesh), r = Make(mesh, true);
  ExpectConsistent(r);
  EXPECT_EQ(SixVolumes(r), SixVolumes(s));
  EXPECT_GT(SixVolumes(s), 0);
  for (std::size_t v = 0; v < s.vertices.size(); ++v) {
    EXPECT_EQ(r.vertices[v], (GridPoint{0, 0, 0} - s.vertices[v]));
  }
}

// A box with a vertex twice in one place, the sliver between them collapsed.
TEST(GridSolid, JoinsEndsThatFellTogether) {
  TriangleMesh mesh = MakeBox({-3, -2, -1}, {3, 2, 1});
  // Split the edge of the first triangle, and let the middle fall on its end.
  const Triangle t = mesh.triangles[0];
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(t[1])]);
  std::vector<Triangle> split;
  for (const Triangle& u : mesh.triangles) {
    bool is_split = false;
    for (std::size_t k = 0; k < 3 && !is_split; ++k) {
      const int a = u[k], b = u[(k + 1) % 3], c = u[(k + 2) % 3];
      if (std::minmax(a, b) != std::minmax(t[0], t[1])) continue;
      split.push_back({a, middle, c});
      split.push_back({middle, b, c});
      is_split = true;
    }
    if (!is_split) split.push_back(u);
  }
  ASSERT_EQ(split.size(), mesh.triangles.size() + 2);
  const GridSolid whole = Make(mesh);
  mesh.triangles = split;
  const GridSolid s = Make(mesh);
  ExpectConsistent(s);
  EXPECT_EQ(s.facets.size(), whole.facets.size());
  EXPECT_EQ(SixVolumes(s), SixVolumes(whole));
}

// The same with the middle on the edge, and a third vertex there: flat facets
// give their middle corners away, and the surface stays.
TEST(GridSolid, DissolvesFacetsWithoutArea) {
  const TriangleMesh box = MakeBox({-4, -2, -1}, {4, 2, 1});
  for (std::size_t f = 0; f < box.triangles.size(); ++f) {
    // A flat pocket in facet f: its edge ab, a new vertex m on it.
    TriangleMesh mesh = box;
    const Triangle t = mesh.triangles[f];
    const int m = static_cast<int>(mesh.vertices.size());
    const Eigen::Vector3d a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d b = mesh.vertices[static_cast<std::size_t>(t[1])];
    mesh.vertices.push_back(0.5 * (a + b));
    mesh.triangles[f] = {t[0], m, t[2]};
    mesh.triangles.push_back({m, t[1], t[2]});
    mesh.triangles.push_back({t[0], t[1], m});  // no area
    const GridSolid s = Make(mesh);
    ExpectConsistent(s);
    EXPECT_EQ(SixVolumes(s), SixVolumes(Make(box))) << f;
    EXPECT_EQ(s.facets.size(), mesh.triangles.size());
  }
}

// Two boxes that share an edge, vertices and all: four facets there.  Paired
// through the solid both edges are convex, paired the other way neither is.
TEST(GridSolid, PairsFourFacetsOfAnEdgeThroughTheSolid) {
  TriangleMesh mesh = MakeBox({-2, -2, -2}, {0, 0, 2});
  const TriangleMesh other = MakeBox({0, 0, -2}, {2, 2, 2});
  std::vector<int> names;
  for (const Eigen::Vector3d& v : other.vertices) {
    const auto known = std::find(mesh.vertices.begin(), mesh.vertices.end(), v);
    names.push_back(static_cast<int>(known - mesh.vertices.begin()));
    if (known == mesh.vertices.end()) mesh.vertices.push_back(v);
  }
  for (const Triangle& t : other.triangles) {
    const auto name = [&](int v) { return names[static_cast<std::size_t>(v)]; };
    mesh.triangles.push_back({name(t[0]), name(t[1]), name(t[2])});
  }
  ASSERT_EQ(mesh.vertices.size(), 14U);
  const GridSolid s = Make(mesh);
  int shared = 0;
  for (const GridEdge& e : s.edges) {
    const GridPoint &a = At(s, e.a), &b = At(s, e.b);
    if (a[0] != 0 || a[1] != 0 || b[0] != 0 || b[1] != 0) continue;
    ++shared;
    EXPECT_TRUE(IsConvex(s, e));
    EXPECT_EQ(e.left < 12, e.right < 12) << "facets of different boxes";
  }
  EXPECT_EQ(shared, 2);
}

TEST(GridSolid, RefusesWhatHasNoInsideByName) {
  const auto refusal = [](const TriangleMesh& mesh) -> std::string {
    return testing::ErrorOf([&] {
      internal::MakeGridSolid(Rounded(mesh), mesh.triangles, false, "cup.off");
    });
  };
  // All in one point.
  EXPECT_NE(refusal(MakeBox({-.1, -.1, -.1}, {.1, .1, .1}))
                .find("cup.off: expected a solid"),
            std::string::npos);
  TriangleMesh open = MakeBox({-3, -2, -1}, {3, 2, 1});
  open.triangles.pop_back();
  EXPECT_NE(refusal(open).find("cup.off: expected a closed mesh"),
            std::string::npos);
}

TEST(GridSolid, BoxesHoldTheirFacets) {
  const GridSolid s = Make(MakeIcoBall(1000.0, 1));
  const std::vector<BoundingBox> boxes = internal::FacetBoxes(s);
  ASSERT_EQ(boxes.size(), s.facets.size());
  for (std::size_t f = 0; f < boxes.size(); ++f) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      std::vector<double> x;
      for (const int v : s.facets[f]) {
        x.push_back(internal::ToDouble(At(s, v))[k]);
      }
      EXPECT_EQ(boxes[f].min[k], *std::min_element(x.begin(), x.end()));
      EXPECT_EQ(boxes[f].max[k], *std::max_element(x.begin(), x.end()));
    }
  }
}

}  // namespace
}  // namespace phongpd
