// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/triangle_quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST(TriangleQuality, IsOneForEquilateralAndZeroForDegenerateTriangles) {
  EXPECT_NEAR(TriangleQuality({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1.0, 1e-15);
  EXPECT_EQ(TriangleQuality({0, 0, 0}, {1, 1, 1}, {3, 3, 3}), 0.0);
  EXPECT_EQ(TriangleQuality({1, 2, 3}, {1, 2, 3}, {1, 2, 3}), 0.0);
  // Half a square: area ½, squared edges 1 + 1 + 2.
  EXPECT_NEAR(TriangleQuality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}),
              std::sqrt(3.0) / 2.0, 1e-15);
}

TEST(TriangleQuality, FollowsTheHeightOfNeedlesAndCapsAtAnyScale) {
  for (const double unit : {1e-80, 1.0, 1e80}) {
    for (const double height : {1e-3, 1e-6}) {
      const Vector3d a(0, 0, 0), b(unit, 0, 0);
      const Vector3d needle(0, height * unit, 0);
      const Vector3d cap(unit / 2, height * unit, 0);
      EXPECT_NEAR(TriangleQuality(a, b, needle) / height, std::sqrt(3.0), 1e-5);
      EXPECT_NEAR(TriangleQuality(a, b, cap) / height, 4.0 / std::sqrt(3.0),
                  1e-5);
    }
  }
}

TEST(TriangleQuality, WorstAndMedianAreOverTriangles) {
  EXPECT_EQ(MeasureQuality({}).worst, 0.0);
  TriangleMesh mesh = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(MeasureQuality(mesh).worst, std::sqrt(3.0) / 2.0, 1e-15);
  mesh.vertices.push_back({1e-4, 0, 0});
  mesh.triangles.push_back({0, 2, 8});
  const QualityFigures figures = MeasureQuality(mesh);
  EXPECT_LT(figures.worst, 1e-3);
  EXPECT_NEAR(figures.median, std::sqrt(3.0) / 2.0, 1e-15);
}

}  // namespace
}  // namespace phongpd
