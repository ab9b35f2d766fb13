// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/depth_bound.h"

#include <gtest/gtest.h>

#include <random>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/oracle_of.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Two boxes leave by a facet: the bound is the depth, in closed form.
TEST(DepthBound, IsTheDepthOfTwoBoxes) {
  const TriangleMesh robot = MakeBox({-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3});
  const TriangleMesh obstacle = MakeBox({-1, -2, -3}, {1, 2, 3});
  const MotionOracle oracle = testing::OracleOf(robot, obstacle);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Vector3d half(1.1, 2.2, 3.3);
    const Vector3d q(share(random) * half.x(), share(random) * half.y(),
                     share(random) * half.z());
    const double depth = (half - q.cwiseAbs()).minCoeff();
    const WayOut way = BoundDepth(robot, obstacle, q, oracle);
    EXPECT_NEAR(way.length, depth, 1e-12) << q.transpose();
    EXPECT_NEAR(way.direction.norm(), 1.0, 1e-12);
  }
}

// By another route: the exact contact space and its Euclidean distance; and
// the way out is one.
TEST(DepthBound, IsNeverLessThanTheDepthAndAWayOut) {
  const TriangleMesh robot = MakeBox({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  for (const TriangleMesh& obstacle :
       {MakeTorus(1.0, 0.4, 24, 12), MakeIcoBall(1.0, 2),
        MakeU(2.0, 0.5, 1.0)}) {
    const EuclideanMetric metric(BuildContactSpace(robot, obstacle));
    const MotionOracle oracle = testing::OracleOf(robot, obstacle);
    std::mt19937_64 random(2);
    const BoundingBox box = ComputeBounds(obstacle);
    int inside = 0;
    double excess = 0.0;
    while (inside < 40) {
      const Vector3d q = RandomPoint(box, &random);
      const double depth = -metric.Query(q).signed_distance;
      if (!(depth > 0.0)) continue;
      ++inside;
      const WayOut way = BoundDepth(robot, obstacle, q, oracle);
      EXPECT_GE(way.length, depth * (1.0 - 1e-9)) << q.transpose();
      const Vector3d out = q + (1.0 + 1e-9) * way.length * way.direction;
      EXPECT_FALSE(oracle.Collides(out)) << q.transpose();
      excess += way.length / depth / 40.0;
    }
    // "At most" is worth saying only if it is not far off.
    EXPECT_LT(excess, 1.5);
  }
}

TEST(DepthBound, IsZeroWhereSolidsTouch) {
  const TriangleMesh robot = MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const TriangleMesh obstacle = MakeBox({-1, -1, -1}, {1, 1, 1});
  const MotionOracle oracle = testing::OracleOf(robot, obstacle);
  for (const Vector3d& q :
       {Vector3d(1.5, 0, 0), Vector3d(0, -1.5, 1.5), Vector3d(1.5, 1.5, 1.5)}) {
    EXPECT_TRUE(oracle.Collides(q));
    EXPECT_EQ(BoundDepth(robot, obstacle, q, oracle).length, 0.0);
  }
}

}  // namespace
}  // namespace phongpd
