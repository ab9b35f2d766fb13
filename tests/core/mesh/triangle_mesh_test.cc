// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST(BoundingBox, OfNoTriangleIsEmpty) {
  TriangleMesh mesh;
  mesh.vertices.emplace_back(1, 2, 3);
  EXPECT_TRUE(ComputeBounds(mesh).IsEmpty());
  EXPECT_EQ(ComputeBounds(mesh).Diagonal(), 0.0);
}

TEST(BoundingBox, IgnoresUnusedVertices) {
  TriangleMesh mesh = MakeBox({-1, -2, -3}, {4, 5, 6});
  mesh.vertices.emplace_back(100, 100, 100);
  const BoundingBox box = ComputeBounds(mesh);
  EXPECT_EQ(box.min, Vector3d(-1, -2, -3));
  EXPECT_EQ(box.max, Vector3d(4, 5, 6));
  EXPECT_DOUBLE_EQ(box.Diagonal(), std::sqrt(25.0 + 49.0 + 81.0));
  EXPECT_EQ(box.Center(), Vector3d(1.5, 1.5, 1.5));
}

TEST(SignedVolume, KeepsItsDigitsFarFromTheOrigin) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 3});
  // Integer offsets keep the coordinates exact, so nothing may be lost.
  for (const double offset : {0.0, 1e6, 1e12}) {
    EXPECT_EQ(SignedVolume(Translated(box, Vector3d::Constant(offset))), 6.0);
  }
}

TEST(SignedVolume, FollowsScaleAndDirection) {
  TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 3});
  for (const double scale : {1e-9, 1e-3, 1e3, 1e9}) {
    EXPECT_NEAR(SignedVolume(Scaled(box, scale)) / (6 * scale * scale * scale),
                1.0, 1e-14);
  }
  EXPECT_NEAR(SignedVolume(Rotated(box, GenericRotation())), 6.0, 1e-14);
  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  EXPECT_EQ(SignedVolume(box), -6.0);
}

TEST(SurfaceArea, OfABoxIsTheSumOfItsFaces) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 2, 3});
  EXPECT_DOUBLE_EQ(SurfaceArea(box), 22.0);
  EXPECT_NEAR(SurfaceArea(Rotated(box, GenericRotation())), 22.0, 1e-13);
  EXPECT_EQ(SurfaceArea(TriangleMesh{}), 0.0);
}

TEST(LabelComponents, NumbersPartsByFirstAppearance) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const TriangleMesh three =
      Joined(Joined(box, MakeIcoBall(1, 1)), Translated(box, {9, 9, 9}));
  int count = 0;
  const std::vector<int> labels = LabelComponents(three, &count);
  ASSERT_EQ(count, 3);
  for (std::size_t t = 0; t < labels.size(); ++t) {
    EXPECT_EQ(labels[t], t < 12 ? 0 : t < 12 + 80 ? 1 : 2);
  }
}

TEST(LabelComponents, JoinsPartsThatShareAVertex) {
  TriangleMesh mesh;
  mesh.vertices.resize(5, Vector3d::Zero());
  mesh.triangles = {{3, 4, 2}, {0, 1, 2}};
  int count = 0;
  EXPECT_EQ(LabelComponents(mesh, &count), std::vector<int>({0, 0}));
  EXPECT_EQ(count, 1);
}

TEST(LabelComponents, OfNothingIsNothing) {
  int count = 7;
  EXPECT_TRUE(LabelComponents(TriangleMesh{}, &count).empty());
  EXPECT_EQ(count, 0);
}

TEST(TriangleNeighbors, AreTheOwnersOfTheOppositeHalfEdges) {
  const TriangleMesh mesh = MakeTorus(2, 0.5, 9, 7);
  std::map<std::pair<int, int>, int> owner;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      owner[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] =
          static_cast<int>(t);
    }
  }
  const auto neighbors = TriangleNeighbors(mesh);
  ASSERT_EQ(neighbors.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < neighbors.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(
          neighbors[t][k],
          (owner.at({mesh.triangles[t][(k + 1) % 3], mesh.triangles[t][k]})));
    }
  }
}

TEST(TriangleNeighbors, AreMissingOnTheBoundary) {
  TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  box.triangles.pop_back();
  int missing = 0;
  for (const auto& of_triangle : TriangleNeighbors(box)) {
    for (const int n : of_triangle) missing += n < 0;
  }
  EXPECT_EQ(missing, 3);
}

}  // namespace
}  // namespace phongpd
