// SPDX-License-Identifier: GPL-3.0-or-later
// Random pairs of voxel solids: nothing is as coplanar, as parallel and as
// coincident as these.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "constraints/collision_oracle.h"
#include "core/contact_space/contact_space.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

enum class Pose { kAligned, kTurnedAlike, kTurnedApart };

struct Pair {
  TriangleMesh robot, obstacle;
};

Pair MakePair(Pose pose, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Pair pair{testing::RandomVoxelSolid(2, 0.5, &random),
            testing::RandomVoxelSolid(3, 0.5, &random)};
  if (pose != Pose::kAligned) {
    const Eigen::Matrix3d turn = testing::RandomRotation(&random);
    pair.obstacle = Rotated(pair.obstacle, turn);
    pair.robot = Rotated(pair.robot, pose == Pose::kTurnedAlike
                                         ? turn
                                         : testing::RandomRotation(&random));
  }
  return pair;
}

class VoxelPairs : public ::testing::TestWithParam<Pose> {};

TEST_P(VoxelPairs, HaveAClosedManifoldContactSpaceThatJudgesEveryPoint) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pair pair = MakePair(GetParam(), seed);
    const ContactSpace c = BuildContactSpace(pair.robot, pair.obstacle);
    ASSERT_TRUE(c.report.closed);
    ASSERT_TRUE(c.report.manifold);
    const CollisionOracle oracle(pair.robot, pair.obstacle);
    const BoundingBox box = ComputeBounds(c.mesh);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d q = testing::RandomPoint(box, &random);
      EXPECT_EQ(oracle.Collides(q), testing::WindingNumber(c.mesh, q) > 0.5)
          << q.transpose();
    }
  }
}

TEST_P(VoxelPairs, HaveTheVolumeOfTheSwappedPair) {
  for (std::uint64_t seed = 100; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Pair pair = MakePair(GetParam(), seed);
    const double ab =
        BuildContactSpace(pair.robot, pair.obstacle).report.volume;
    const double ba =
        BuildContactSpace(pair.obstacle, pair.robot).report.volume;
    EXPECT_NEAR(ab, ba, 1e-9 * ab);
  }
}

INSTANTIATE_TEST_SUITE_P(Poses, VoxelPairs,
                         ::testing::Values(Pose::kAligned, Pose::kTurnedAlike,
                                           Pose::kTurnedApart));

}  // namespace
}  // namespace phongpd
