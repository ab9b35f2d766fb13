// SPDX-License-Identifier: GPL-3.0-or-later
// A build that would take minutes, stopped by another thread.
#include <gtest/gtest.h>

#include <string>

#include "core/contact/contact_space.h"
#include "core/contact/depth.h"
#include "problems/shapes/shapes.h"
#include "tests/support/cancelled_work.h"

namespace phongpd {
namespace {

TEST(BuildCancellation, StopsARunningBuildAndNoLaterOne) {
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);  // minutes on itself
  const std::string what =
      testing::WhatCancels([&] { BuildContactSpace(knot, knot); });
  EXPECT_EQ(what.find("robot and obstacle: the contact space was cancelled"),
            0u)
      << what;
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(BuildContactSpace(box, box).report().components, 1);
}

// A query is asked again and again: what stopped one answer stops no other.
TEST(BuildCancellation, StopsADepthAndNoLaterOneOfTheSameQuery) {
  const TriangleMesh box = MakeBox({0, 0, 0}, {1, 1, 1});
  const DepthQuery boxes(box, box);
  const TriangleMesh knot = MakeKnot(1.0, 0.2, 96, 24);
  const DepthQuery knots(knot, knot);
  EXPECT_NE(testing::WhatCancels([&] { knots.At(Eigen::Vector3d::Zero()); }),
            "");
  const Depth depth = boxes.At(Eigen::Vector3d(0.25, 0.0, 0.0));
  EXPECT_TRUE(depth.certified);
  EXPECT_NEAR(depth.depth, 0.75, 1e-12);
}

}  // namespace
}  // namespace phongpd
