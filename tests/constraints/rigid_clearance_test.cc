// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of what turns past what, and distances of all pairs of
// triangles at many poses, placed by another route than quaternions.
#include "constraints/rigid/rigid_clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/random_pairs.h"
#include "tests/support/rigid_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::AboutZ;
using testing::Cube;
using testing::ExpectRefused;
using testing::MeshDistance;
using testing::PlacedMesh;
using testing::PoseAt;
using testing::RandomRotation;
using testing::RandomVoxelSolid;

void ExpectHolds(const RigidClearance& found, double truth, double relative) {
  EXPECT_LE(found.lower, truth);
  EXPECT_GE(found.upper, truth);
  EXPECT_TRUE(found.is_resolved);
  EXPECT_LE(found.upper - found.lower,
            relative * found.upper * (1.0 + 1e-12) + 1e-8);
}

// A cube of side 2 that turns a quarter: its edge comes out to √2.
TEST(RigidClearance, IsTheGapThatATurningCubeLeavesToAWall) {
  const TriangleMesh cube = Cube(2.0);
  for (const double gap : {3.0, 0.3, 1e-2, 1e-4, 1e-6}) {
    const double x = std::sqrt(2.0) + gap;
    const TriangleMesh wall = MakeBox({x, -5.1, -4.0}, {x + 1, 4.0, 3.7});
    const RigidJudge judge(cube, wall);
    for (const double begin : {-0.1, 0.0, 0.3}) {
      const RigidMotion motion(PoseAt(Vector3d::Zero(), AboutZ(begin)),
                               PoseAt(Vector3d::Zero(), AboutZ(begin + 1.5)));
      for (const double relative : {0.3, 1e-3, 1e-6}) {
        const RigidClearance found = judge.Clearance(motion, {relative, 0.0});
        ExpectHolds(found, gap, relative);
        EXPECT_EQ(found.robot_mesh, 0);
        EXPECT_GE(found.obstacle_triangle, 0);
        EXPECT_LT(found.tests, 100'000);
      }
      const double time = judge.Clearance(motion, {1e-6, 0.0}).time;
      if (gap < 1.0) {
        EXPECT_NEAR(begin + 1.5 * time, 0.25 * kPi, 0.01);
      }
    }
  }
}

// About its own middle a ball keeps its place, about another point it swings.
TEST(RigidClearance, IsTheGapThatASwingingBallLeavesToAPlane) {
  const TriangleMesh ball = Translated(MakeIcoBall(1.0, 2), {3.0, 0.0, 0.0});
  const TriangleMesh floor = MakeBox({-9, -9, -2}, {9, 9, -1.0});
  const RigidMotion motion = RigidMotion::Turning(
      PoseAt({0.0, 0.0, 4.5}), {0.5, 0.0, 4.5}, {0.0, kPi, 0.0});
  const RigidClearance found =
      MotionClearance(ball, floor, motion, {1e-4, 0.0});
  // At a half, straight down; a corner of it is lowest.
  double truth = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= 2'000; ++k) {
    const TriangleMesh placed = PlacedMesh(ball, motion, k / 2'000.0);
    for (const Vector3d& v : placed.vertices) {
      truth = std::min(truth, v.z() + 1.0);
    }
  }
  EXPECT_LE(found.lower, truth);
  EXPECT_NEAR(found.upper, truth, 3e-4 * truth);
  EXPECT_NEAR(found.upper, 1.5, 0.05);
  EXPECT_TRUE(found.is_resolved);
}

TEST(RigidClearance, IsTheSameAllAlongAWall) {
  const RigidJudge judge(Cube(2.0), MakeBox({-50, -50, -3}, {50, 50, -1.25}));
  const RigidClearance found =
      judge.Clearance({PoseAt({-20, 3, 0}), PoseAt({20, -3, 0}, AboutZ(2.0))});
  ExpectHolds(found, 0.25, 1e-3);
}

TEST(RigidClearance, IsNoneWhereItCollidesTouchesOrIsInside) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const RigidClearance hit =
      judge.Clearance({PoseAt({-3, 0, 0}), PoseAt({3, 0, 0}, AboutZ(1.0))});
  EXPECT_EQ(hit.lower, 0.0);
  EXPECT_LE(hit.upper, 1e-8);
  EXPECT_TRUE(hit.is_resolved);
  EXPECT_NEAR(hit.time, 0.5, 0.5);
  const RigidClearance touch =
      judge.Clearance({PoseAt({-3, 0, 2}), PoseAt({3, 0.3, 2})});
  EXPECT_EQ(touch.lower, 0.0);
  EXPECT_LE(touch.upper, 1e-8);
  const RigidClearance inside =
      MotionClearance(Cube(0.5), Cube(4.0),
                      {PoseAt({0, 0, 0}), PoseAt({0.3, 0, 0}, AboutZ(1.0))});
  EXPECT_EQ(inside.lower, 0.0);
  EXPECT_EQ(inside.upper, 0.0);
  EXPECT_EQ(inside.robot_triangle, -1);
  // In a room there is no inside.
  const RigidClearance room = MotionClearance(
      Cube(0.5), Reversed(Cube(4.0)), {PoseAt({0, 0, 0}), PoseAt({0, 1, 0})});
  ExpectHolds(room, 0.75, 1e-3);
  EXPECT_NEAR(room.time, 1.0, 1e-3);
}

// The bound is never above a distance at any of many poses, and the time that
// is told has the distance that is told.
TEST(RigidClearance, IsNeverMoreThanADistanceOnTheWay) {
  std::mt19937_64 random(5);
  int free = 0, tight = 0;
  for (int i = 0; i < 60; ++i) {
    const TriangleMesh robot = RandomVoxelSolid(2, 0.6, &random);
    const TriangleMesh obstacle = RandomVoxelSolid(3, 0.4, &random);
    const RigidJudge judge(robot, obstacle);
    std::uniform_real_distribution<double> place(-4.0, 4.0), turn(0.0, 3.0);
    const auto point = [&] {
      return Vector3d(place(random), place(random), place(random));
    };
    const Vector3d start = point(), end = point();
    const RigidMotion motion = RigidMotion::Turning(
        PoseAt(start, Quaterniond(RandomRotation(&random))), end,
        turn(random) * RandomRotation(&random).col(0));
    const double relative = i % 2 == 0 ? 1e-2 : 1e-4;
    const RigidClearance found = judge.Clearance(motion, {relative, 0.0});
    ASSERT_TRUE(found.is_resolved);
    const MotionVerdict outcome = judge.Check(motion).outcome;
    EXPECT_EQ(found.lower > 0.0, outcome == MotionVerdict::kFree) << i;
    if (!(found.lower > 0.0)) continue;
    ++free;
    double least =
        MeshDistance(PlacedMesh(robot, motion, found.time), obstacle);
    EXPECT_LE(least, found.upper) << i;
    EXPECT_GE(least, found.lower) << i;
    if (least >= found.upper * (1.0 - relative)) ++tight;
    for (int k = 0; k <= 60; ++k) {
      const double t = k / 60.0;
      ASSERT_GE(MeshDistance(PlacedMesh(robot, motion, t), obstacle),
                found.lower)
          << i << " at " << t;
    }
  }
  EXPECT_GT(free, 15);
  EXPECT_EQ(tight, free);
}

// The other motion through the same orientations is another way where it
// translates, too, and the same where it does not.
TEST(RigidClearance, IsToldOfAQuaternionThatIsLinear) {
  const RigidJudge judge(Cube(2.0), MakeBox({1.9, -5, -4}, {3, 5, 4}));
  const RobotPose start = PoseAt({0, 0, 0}, AboutZ(-0.2));
  const RobotPose turned = PoseAt({0, 0, 0}, AboutZ(2.2));
  const double truth = 1.9 - std::sqrt(2.0);
  ExpectHolds(judge.Clearance(RigidMotion(start, turned)), truth, 1e-3);
  ExpectHolds(judge.Clearance(QuaternionMotion::Between(start, turned)), truth,
              1e-3);
  const RobotPose from = PoseAt({-0.6, 0, 0}, AboutZ(0.6));
  const RobotPose to = PoseAt({0.4, 0, 0}, AboutZ(kPi));
  const double one = judge.Clearance(RigidMotion(from, to)).lower;
  const double other =
      judge.Clearance(QuaternionMotion::Between(from, to)).lower;
  EXPECT_GT(std::abs(one - other), 1e-3);
}

TEST(RigidClearance, OfAPathIsThatOfItsClosestMotion) {
  const RigidJudge judge(Cube(2.0), MakeBox({3.0, -5, -4}, {4, 5, 4}));
  const std::vector<RobotPose> path = {PoseAt({-9, 0, 0}), PoseAt({0, 0, 0}),
                                       PoseAt({0, 0, 0}, AboutZ(1.5)),
                                       PoseAt({-1, 0, 0}, AboutZ(1.5))};
  const RigidClearance found = judge.PathClearance(path);
  ExpectHolds(found, 3.0 - std::sqrt(2.0), 1e-3);
  EXPECT_EQ(found.motion, 1);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    least = std::min(least,
                     judge.Clearance(RigidMotion(path[i], path[i + 1])).upper);
  }
  EXPECT_NEAR(found.upper, least, 1e-3 * least);
  ExpectHolds(judge.PathClearance({path[1]}), 2.0, 1e-3);
  ExpectRefused([&] { judge.PathClearance({}); },
                "expected a path of at least one pose, found none");
}

TEST(RigidClearance, IsHonestWhereItMayLookNoFurther) {
  const RigidJudge judge(Cube(2.0), MakeIcoBall(1.0, 3));
  const RigidMotion motion(PoseAt({3, 0, 0}), PoseAt({0, 3, 0}, AboutZ(1.0)));
  const RigidClearance whole = judge.Clearance(motion);
  for (const long limit : {0L, 5L, 50L, 500L, 5000L}) {
    const RigidClearance found = judge.Clearance(motion, {}, limit);
    EXPECT_LE(found.tests, limit);
    EXPECT_LE(found.lower, whole.upper);
    EXPECT_GE(found.upper, whole.lower);
    EXPECT_TRUE(std::isfinite(found.upper));
    if (found.is_resolved) {
      EXPECT_GT(found.lower, 0.99 * found.upper);
    }
  }
  EXPECT_FALSE(judge.Clearance(motion, {}, 5).is_resolved);
  EXPECT_TRUE(whole.is_resolved);
  for (const double bad : {-1e-9, 1.0, std::nan("")}) {
    ExpectRefused(
        [&] {
          judge.Clearance(motion, {bad, 0.0});
        },
        "clearance tolerance: relative: expected a share in [0, 1)");
  }
  ExpectRefused(
      [&] {
        judge.Clearance(motion, {0.1, -1.0});
      },
      "clearance tolerance: absolute: expected a length");
}

// In other units, and far from the origin, it is the same length.
TEST(RigidClearance, ScalesWithTheUnit) {
  for (const double unit : {1e-60, 1e-6, 1.0, 1e6, 1e60}) {
    const TriangleMesh wall = Scaled(MakeBox({1.5, -5, -4}, {3, 5, 4}), unit);
    const RigidClearance found =
        RigidJudge(Scaled(Cube(2.0), unit), wall)
            .Clearance({PoseAt({0, 0, 0}), PoseAt({0, 0, 0}, AboutZ(1.0))});
    const double truth = 1.5 - std::sqrt(2.0);
    EXPECT_LE(found.lower, truth * unit);
    EXPECT_GE(found.upper, truth * unit * (1.0 - 1e-12));
    EXPECT_LE(found.upper - found.lower, 1.0001e-3 * found.upper);
  }
}

}  // namespace
}  // namespace phongpd
