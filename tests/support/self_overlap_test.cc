// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/self_overlap.h"

#include <gtest/gtest.h>

#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

const Corners kFlat = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 0, 0),
                       Eigen::Vector3d(0, 2, 0)};

Corners Upright(double bottom) {
  return {Eigen::Vector3d(0.5, 0.5, bottom), Eigen::Vector3d(0.5, 0.5, 3),
          Eigen::Vector3d(0.6, 0.6, 3)};
}

TEST(OverlapDepth, IsHowFarAPiercingCornerReaches) {
  EXPECT_NEAR(OverlapDepth(kFlat, Upright(-0.125)), 0.125, 1e-15);
  EXPECT_NEAR(OverlapDepth(kFlat, Upright(-1e-12)), 1e-12, 1e-18);
  EXPECT_NEAR(OverlapDepth(Upright(-0.125), kFlat), 0.125, 1e-15);
}

TEST(OverlapDepth, IsNotPositiveForTrianglesApartOrTouching) {
  EXPECT_LE(OverlapDepth(kFlat, Upright(0.0)), 0.0);
  EXPECT_LT(OverlapDepth(kFlat, Upright(0.1)), 0.0);
  EXPECT_LE(OverlapDepth(kFlat, kFlat), 0.0);
  Corners neighbour = {kFlat[1], kFlat[0], Eigen::Vector3d(1, -1, 1)};
  EXPECT_LE(OverlapDepth(kFlat, neighbour), 0.0);
}

TEST(DeepestSelfOverlap, IsZeroOnSolidsAndFindsACrossing) {
  EXPECT_LT(DeepestSelfOverlap(MakeTorus(2, 0.6, 24, 12)), 1e-14);
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(DeepestSelfOverlap(box), 0.0);
  const Eigen::Vector3d step(0.25, 0.375, 0.5);
  EXPECT_NEAR(DeepestSelfOverlap(Joined(box, Translated(box, step))), 0.5,
              0.25);
}

}  // namespace
}  // namespace phongpd
