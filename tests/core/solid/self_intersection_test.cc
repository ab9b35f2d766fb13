// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solid/self_intersection.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <random>

#include "problems/shapes/shapes.h"

namespace phongpd::internal {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using Corners = std::array<Point, 3>;

Corners CornersOf(const TriangleMesh& mesh, std::size_t t) {
  Corners corners;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& v = mesh.vertices[mesh.triangles[t][k]];
    corners[k] = Point(v.x(), v.y(), v.z());
  }
  return corners;
}

// The triangle shrunk towards its centre by less than any feature of the
// tests: what it meets, the inside of the triangle meets.
Kernel::Triangle_3 Inside(const Corners& c) {
  const Kernel::FT shrink = 1e-60;
  const Point center = CGAL::centroid(c[0], c[1], c[2]);
  return {c[0] + shrink * (center - c[0]), c[1] + shrink * (center - c[1]),
          c[2] + shrink * (center - c[2])};
}

// The other route: no cases, but two tests on rational numbers.
bool MeetProperly(const Corners& a, const Corners& b) {
  if (CGAL::collinear(a[0], a[1], a[2])) return false;
  if (CGAL::collinear(b[0], b[1], b[2])) return false;
  const Kernel::Triangle_3 s(a[0], a[1], a[2]), t(b[0], b[1], b[2]);
  return CGAL::do_intersect(Inside(a), t) || CGAL::do_intersect(s, Inside(b));
}

std::size_t CountBruteForce(const TriangleMesh& mesh,
                            const std::vector<int>& labels) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < mesh.triangles.size(); ++s) {
    for (std::size_t t = s + 1; t < mesh.triangles.size(); ++t) {
      if (labels[s] != labels[t]) continue;
      count += MeetProperly(CornersOf(mesh, s), CornersOf(mesh, t));
    }
  }
  return count;
}

TriangleMesh RandomSoup(int vertices, int triangles, int grid,
                        std::mt19937* random) {
  std::uniform_int_distribution<int> coordinate(0, grid);
  std::uniform_int_distribution<int> index(0, vertices - 1);
  TriangleMesh mesh;
  for (int i = 0; i < vertices; ++i) {
    const int x = coordinate(*random), y = coordinate(*random);
    mesh.vertices.emplace_back(x, y, coordinate(*random));
  }
  for (int i = 0; i < triangles; ++i) {
    const int a = index(*random), b = index(*random);
    mesh.triangles.push_back({a, b, index(*random)});
  }
  return mesh;
}

// Expects the count to be that of the other route, and returns it.
std::size_t ExpectAgreement(const TriangleMesh& mesh,
                            const std::vector<int>& labels) {
  const std::size_t expected = CountBruteForce(mesh, labels);
  EXPECT_EQ(CountSelfIntersections(mesh, labels), expected);
  return expected;
}

Eigen::Matrix3d Turn() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized())
      .toRotationMatrix();
}

TEST(SelfIntersections, AgreeWithConstructedIntersectionsOfRandomSoups) {
  std::mt19937 random(1);
  std::size_t total = 0;
  // The small grids are full of common corners, edges, planes and of
  // degenerate triangles.
  for (const int grid : {1, 2, 3, 1000}) {
    for (int run = 0; run < 25; ++run) {
      const TriangleMesh mesh = RandomSoup(14, 24, grid, &random);
      std::vector<int> labels;
      for (int t = 0; t < 24; ++t) labels.push_back(t % 5 == 0);
      total += ExpectAgreement(mesh, labels);
    }
  }
  EXPECT_GT(total, 1000u);
}

// In one plane nothing but lines through edges parts triangles.
TEST(SelfIntersections, AgreeWithConstructedIntersectionsInOnePlane) {
  std::mt19937 random(3);
  const Eigen::Matrix3d turn = Turn();
  std::size_t total = 0;
  for (const double scale : {1.0, 1e-95}) {
    for (int run = 0; run < 40; ++run) {
      TriangleMesh mesh = RandomSoup(14, 24, 4, &random);
      for (Eigen::Vector3d& v : mesh.vertices) v.z() = 1.0;
      // Some stay in the plane exactly, some to rounding.
      if (run % 2 == 1) mesh = Rotated(mesh, turn);
      mesh = Scaled(mesh, scale);
      SCOPED_TRACE(scale);
      total += ExpectAgreement(mesh, std::vector<int>(24, 0));
    }
  }
  EXPECT_GT(total, 1000u);
}

// Corners that were on planes and edges of others are off them by their last
// bits: what doubles say of a side is wrong about as often as right.
TEST(SelfIntersections, AgreeWithConstructedIntersectionsOfTurnedGrids) {
  std::mt19937 random(2);
  const Eigen::Matrix3d turn = Turn();
  std::size_t total = 0;
  for (const double scale : {1.0, 1e-30, 1e30, 1e-95}) {
    for (int run = 0; run < 25; ++run) {
      TriangleMesh mesh = RandomSoup(14, 24, 2, &random);
      for (Eigen::Vector3d& v : mesh.vertices) v = scale * (turn * v);
      SCOPED_TRACE(scale);
      total += ExpectAgreement(mesh, std::vector<int>(24, 0));
    }
  }
  EXPECT_GT(total, 1000u);
}

TEST(SelfIntersections, OfASphereThatWasPushedThroughItself) {
  TriangleMesh ball = MakeIcoBall(1, 2);
  const std::vector<int> one_part(ball.triangles.size(), 0);
  EXPECT_EQ(CountSelfIntersections(ball, one_part), 0u);
  ball.vertices[0] = -1.5 * ball.vertices[0];
  const std::size_t expected = CountBruteForce(ball, one_part);
  EXPECT_GT(expected, 0u);
  EXPECT_EQ(CountSelfIntersections(ball, one_part), expected);
}

TEST(SelfIntersections, DoNotDependOnScaleOrPlace) {
  TriangleMesh ball = MakeIcoBall(1, 2);
  ball.vertices[0] = -1.5 * ball.vertices[0];
  const std::vector<int> one_part(ball.triangles.size(), 0);
  const std::size_t expected = CountSelfIntersections(ball, one_part);
  for (const double scale : {0x1p-1000, 0x1p-30, 0x1p30, 0x1p900}) {
    EXPECT_EQ(CountSelfIntersections(Scaled(ball, scale), one_part), expected)
        << scale;
  }
  const TriangleMesh moved = Translated(ball, Eigen::Vector3d(1e6, -2e6, 3e6));
  EXPECT_EQ(CountSelfIntersections(moved, one_part), expected);
}

TEST(SelfIntersections, CountTrianglesFoldedOntoEachOther) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};  // same side of the common edge
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 1u);
  mesh.triangles = {{0, 1, 2}, {1, 0, 4}};  // opposite sides
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 0u);
  mesh.vertices[3] = {1, 1, 5e-324};  // open by the smallest double
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 0u);
}

TEST(SelfIntersections, DoNotCountEdgesThatMeetEdges) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0},  {0, 4, 0}, {1, 0, 0},
                   {2, 0, 0}, {1, -1, 3}, {2, 0, 3}, {2, 0, -3}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};  // along a part of an edge
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 0u);
  mesh.triangles = {{0, 1, 2}, {6, 7, 5}};  // crossing it from outside
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 0u);
  mesh.vertices[5] = {1, 1, 3};  // from inside
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 1u);
  mesh.vertices[4] = {2, 1, 0};  // an end of the edge on the face
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(CountSelfIntersections(mesh, {0, 0}), 1u);
}

TEST(Intersect, TellsCrossingFromTouchingAndApart) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(Intersect(box, Translated(box, {0.5, 0.5, 0.5})));
  EXPECT_TRUE(Intersect(box, Translated(box, {1, 0.5, 0})));  // half a face
  EXPECT_TRUE(Intersect(box, box));
  EXPECT_FALSE(Intersect(box, Translated(box, {1, 1, 1})));  // one corner
  EXPECT_FALSE(Intersect(box, Translated(box, {1, 1, 0})));  // one edge
  EXPECT_FALSE(Intersect(box, Translated(box, {2, 0, 0})));
  EXPECT_FALSE(Intersect(box, MakeBox({0.25, 0.25, 0.25}, {0.5, 0.5, 0.5})));
}

}  // namespace
}  // namespace phongpd::internal
