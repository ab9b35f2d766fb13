// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exact collision test, at points of boxes that are said to be
// occupied.
#include "core/minkowski/convolution/occupied_region.h"

#include <gtest/gtest.h>

#include <random>

#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/grid_pair.h"
#include "core/minkowski/operands/solid_collision.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Balls and boxes that overlap, some of them cavities, in others or astray.
TriangleMesh RandomComponents(std::mt19937_64* random) {
  const BoundingBox box = {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)};
  TriangleMesh mesh = MakeIcoBall(1.0, 2);
  for (int i = 0; i < 4; ++i) {
    const Vector3d place = testing::RandomPoint(box, random);
    const double size = 0.3 + 0.2 * static_cast<double>((*random)() % 4);
    const TriangleMesh part = Translated(
        (*random)() % 2 == 0 ? MakeIcoBall(size, 1)
                             : Rotated(MakeBox(Vector3d::Constant(-size),
                                               Vector3d::Constant(size)),
                                       GenericRotation()),
        place);
    mesh = Joined(mesh, i % 2 == 0 ? Reversed(part) : part);
  }
  return mesh;
}

void Compare(const TriangleMesh& robot, const TriangleMesh& obstacle,
             std::mt19937_64* random, int* boxes) {
  const GridPair pair = MakeGridPair(robot, "a", obstacle, "b");
  const Convolution convolution =
      ReducedConvolution(pair.obstacle, pair.reflected_robot);
  const BuildLimits limits({});
  const OccupiedRegion occupied(pair.obstacle, pair.reflected_robot,
                                convolution, limits);
  const SolidCollision judge(pair.obstacle, pair.reflected_robot);
  const BoundingBox all =
      FeatureSums(pair.obstacle, pair.reflected_robot).bounds();
  for (int i = 0; i < 2000; ++i) {
    const Vector3d a = testing::RandomPoint(all, random);
    const Vector3d b = a + 0.01 * (testing::RandomPoint(all, random) - a);
    const BoundingBox box = {a.cwiseMin(b), a.cwiseMax(b)};
    if (!occupied.Contains(box)) continue;
    ++*boxes;
    for (int k = 0; k < 3; ++k) {
      const Vector3d q = k == 0 ? a : k == 1 ? b : box.Center();
      ASSERT_TRUE(judge.Collide(q)) << q.transpose();
    }
  }
}

TEST(OccupiedRegion, IsOccupiedWhateverCavitiesOverlap) {
  std::mt19937_64 random(12);
  int boxes = 0;
  for (int run = 0; run < 24; ++run) {
    SCOPED_TRACE(run);
    const TriangleMesh robot =
        run % 3 == 0   ? Scaled(RandomComponents(&random), 0.5)
        : run % 3 == 1 ? MakeStar(0.2, 0.5)
                       : TriangleMesh(MakeIcoBall(0.3 + 0.1 * (run % 5), 1));
    Compare(robot, RandomComponents(&random), &random, &boxes);
    Compare(RandomComponents(&random), robot, &random, &boxes);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(boxes, 5000);
}

// In a larger box, most of which is free, a smaller share of what is tried.
TEST(OccupiedRegion, IsFoundWithinWalls) {
  std::mt19937_64 random(13);
  const TriangleMesh star = MakeStar(0.5, 1.2),
                     knot = MakeKnot(0.5, 0.2, 48, 6);
  int alone = 0, within = 0;
  const TriangleMesh walls =
      Joined(MakeBox(Vector3d::Constant(-3.5), Vector3d::Constant(3.5)),
             Reversed(MakeBox(Vector3d::Constant(-3), Vector3d::Constant(3))));
  Compare(star, knot, &random, &alone);
  Compare(star, Joined(knot, walls), &random, &within);
  EXPECT_GT(alone, 100);
  EXPECT_GT(within, 10);
}

}  // namespace
}  // namespace phongpd::internal
