// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of when what meets what; otherwise the judge's yes or no
// of the motion cut before and after, and CGAL's exact kernel at the hit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
using testing::Cube;
using testing::MeetExactly;
using testing::PlacedMesh;
using testing::PoseAt;
using testing::RandomRotation;
using testing::RandomVoxelSolid;

// A cube of side 2 turns by 90° in front of a wall at x: its corner, √2 out, is
// there first after 45° − acos(x / √2).
TEST(RigidFirstHit, IsWhereACornerThatTurnsMeetsAWall) {
  const TriangleMesh cube = Cube(2.0);
  const RigidMotion motion(
      PoseAt(Vector3d::Zero()),
      PoseAt(Vector3d::Zero(),
             Quaterniond(Eigen::AngleAxisd(0.5 * kPi, Vector3d::UnitZ()))));
  for (const double x : {1.001, 1.1, 1.25, 1.4, 1.41}) {
    const RigidJudge judge(cube, MakeBox({x, -5.1, -4.0}, {x + 1, 4.0, 3.7}));
    const double truth = 0.5 - std::acos(x / std::sqrt(2.0)) / (0.5 * kPi);
    const RigidFirstHit hit = judge.FirstHit(motion);
    ASSERT_EQ(hit.outcome, MotionVerdict::kCollides) << x;
    EXPECT_LE(hit.from, truth + 1e-12) << x;
    EXPECT_GE(hit.to, truth - 1e-12) << x;
    EXPECT_LE(hit.to - hit.from, 1e-9) << x;
    EXPECT_GE(hit.robot_triangle, 0);
    for (const double resolution : {1.0, 1e-3, 1e-6}) {
      const RigidFirstHit rough = judge.FirstHit(motion, resolution);
      EXPECT_LE(rough.to - rough.from, resolution) << x;
      EXPECT_LE(rough.from, truth + 1e-12) << x;
      EXPECT_GE(rough.to, truth - 1e-12) << x;
    }
  }
}

// Ways straight on, from anywhere, into the face of a box.
TEST(RigidFirstHit, IsTheShareOfAStraightWayToAFace) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> place(-0.7, 0.7);
  for (int i = 0; i < 50; ++i) {
    const RigidJudge judge(Cube(0.5), Cube(2.0));
    const double x = 2.0 + std::abs(place(random));
    const RigidMotion motion(PoseAt({x, place(random), place(random)}),
                             PoseAt({-3.0, place(random), place(random)}));
    const RigidFirstHit hit = judge.FirstHit(motion);
    const double truth = (x - 1.25) / (x + 3.0);
    ASSERT_EQ(hit.outcome, MotionVerdict::kCollides);
    EXPECT_LE(hit.from, truth + 1e-13);
    EXPECT_GE(hit.to, truth - 1e-13);
    EXPECT_LE(hit.to - hit.from, 1e-9);
  }
}

TEST(RigidFirstHit, SaysFreeUndecidedAndInsideAsCheckDoes) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const RigidFirstHit free =
      judge.FirstHit({PoseAt({-3, 0, 2.001}), PoseAt({3, 0.3, 2.001})});
  EXPECT_EQ(free.outcome, MotionVerdict::kFree);
  EXPECT_EQ(free.from, 0.0);
  EXPECT_EQ(free.to, 1.0);
  EXPECT_EQ(free.robot_triangle, -1);
  // Faces that slide on each other between x = −2 and 2.
  const RigidFirstHit slides =
      judge.FirstHit({PoseAt({-3, 0, 2}), PoseAt({3, 0.3, 2})});
  EXPECT_EQ(slides.outcome, MotionVerdict::kUndecided);
  EXPECT_NEAR(slides.from, 1.0 / 6.0, 1e-5);
  EXPECT_GE(slides.to, 5.0 / 6.0 - 1e-6);
  EXPECT_GE(slides.robot_triangle, 0);
  // One that slides, then is pushed in, may have met before it surely has.
  const RigidFirstHit inside =
      RigidJudge(Cube(0.5), Cube(2.0))
          .FirstHit({PoseAt({0, 0, 0}), PoseAt({3, 0, 0})});
  EXPECT_EQ(inside.outcome, MotionVerdict::kCollides);
  EXPECT_EQ(inside.to, 0.0);
  EXPECT_EQ(inside.robot_triangle, -1);
  const RigidFirstHit little =
      judge.FirstHit({PoseAt({-3, 0, 1}), PoseAt({3, 0, 1})}, 1e-9, 0);
  EXPECT_EQ(little.outcome, MotionVerdict::kUndecided);
  EXPECT_EQ(little.from, 0.0);
  EXPECT_EQ(little.to, 1.0);
}

// Cut where it is said to be free, it is; at `to` the triangles meet.
TEST(RigidFirstHit, IsFreeBeforeAndMeetsAfterOnRandomMotions) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-2.0, 2.0), angle(0.0, 2.0);
  long hits = 0, fine = 0;
  for (int i = 0; i < 300; ++i) {
    const TriangleMesh robot = RandomVoxelSolid(2, 0.6, &random);
    const TriangleMesh obstacle = RandomVoxelSolid(3, 0.5, &random);
    const RigidJudge judge(robot, obstacle);
    const auto point = [&] {
      return Vector3d(place(random), place(random), place(random));
    };
    const Vector3d start = point(), end = point();
    const RigidMotion motion = RigidMotion::Turning(
        PoseAt(start, Quaterniond(RandomRotation(&random))), end,
        angle(random) * RandomRotation(&random).col(0));
    const RigidFirstHit hit = judge.FirstHit(motion);
    EXPECT_EQ(hit.outcome, judge.Check(motion).outcome);
    if (hit.outcome != MotionVerdict::kCollides) continue;
    ++hits;
    EXPECT_LE(hit.from, hit.to);
    if (hit.to - hit.from <= 1e-8) ++fine;
    if (hit.robot_triangle >= 0) {
      EXPECT_TRUE(MeetExactly(PlacedMesh(robot, motion, hit.to),
                              hit.robot_triangle, obstacle,
                              hit.obstacle_triangle));
    }
    const double before = hit.from - 1e-6;
    if (before <= 0.0) continue;
    const RigidMotion cut = RigidMotion::Turning(
        motion.start(), motion.At(before).position, before * motion.turn());
    EXPECT_NE(judge.Check(cut).outcome, MotionVerdict::kCollides) << i;
    for (int k = 0; k <= 50; ++k) {
      EXPECT_FALSE(
          MeetExactly(PlacedMesh(robot, motion, before * k / 50), obstacle));
    }
  }
  EXPECT_GT(hits, 25);
  EXPECT_GE(fine, hits * 9 / 10);
}

TEST(RigidFirstHit, RefusesAResolutionThatIsNone) {
  const RigidJudge judge(Cube(1.0), Cube(1.0));
  const RigidMotion motion(PoseAt({3, 0, 0}), PoseAt({0, 0, 0}));
  for (const double bad : {0.0, -1e-9, 1.5, std::nan("")}) {
    testing::ExpectRefused([&] { judge.FirstHit(motion, bad); },
                           "expected a resolution above 0 and at most 1");
  }
}

}  // namespace
}  // namespace phongpd
