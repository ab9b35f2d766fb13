// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of what turns past what; triangles that are said to meet
// do in CGAL's exact kernel.
#include "constraints/rigid/rigid_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/rigid_truth.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::AboutZ;
using testing::Cube;
using testing::ExpectRefused;
using testing::MeetExactly;
using testing::PlacedMesh;
using testing::PoseAt;
using testing::RandomRotation;

// The triangles named do meet when it says, exactly.
void ExpectWitness(const TriangleMesh& robot, const TriangleMesh& obstacle,
                   const RigidMotion& motion, const RigidCheck& check) {
  ASSERT_EQ(check.outcome, MotionVerdict::kCollides);
  ASSERT_GE(check.robot_triangle, 0);
  EXPECT_TRUE(MeetExactly(PlacedMesh(robot, motion, check.time),
                          check.robot_triangle, obstacle,
                          check.obstacle_triangle))
      << check.time;
}

// A cube of side 2 that turns a quarter in front of a wall: its edge comes out
// to √2 at 45°, which is at no simple share of the way.
RigidMotion QuarterTurn(double begin) {
  return {PoseAt(Vector3d::Zero(), AboutZ(begin)),
          PoseAt(Vector3d::Zero(), AboutZ(begin + 0.5 * kPi))};
}

TEST(RigidJudge, KnowsACubeThatTurnsPastAWallDownToItsResolution) {
  const TriangleMesh cube = Cube(2.0);
  for (const double gap : {0.3, 1e-2, 1e-4, 1e-6, 1e-7, 1e-8, 1e-9, 0.0}) {
    for (const double sign : {1.0, -1.0}) {
      for (const double begin : {-0.1, 0.0, 0.3, 0.7}) {
        const double x = std::sqrt(2.0) + sign * gap;
        const TriangleMesh wall = MakeBox({x, -5.1, -4.0}, {x + 1, 4.0, 3.7});
        const RigidJudge judge(cube, wall);
        const RigidMotion motion = QuarterTurn(begin);
        const RigidCheck check = judge.Check(motion);
        const bool is_free = sign > 0.0 && gap > 0.0;
        if (is_free) {
          EXPECT_NE(check.outcome, MotionVerdict::kCollides) << gap;
        } else {
          EXPECT_NE(check.outcome, MotionVerdict::kFree) << gap;
        }
        if (gap >= 1e-6) {
          EXPECT_NE(check.outcome, MotionVerdict::kUndecided)
              << sign * gap << ' ' << begin << ' ' << check.time;
          EXPECT_LE(check.tests, 20000);
        }
        if (check.outcome == MotionVerdict::kCollides) {
          ExpectWitness(cube, wall, motion, check);
        }
      }
    }
  }
}

// The same from anywhere in space, in other units, turned.
TEST(RigidJudge, SaysTheSameFarAwayTinyAndTurned) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 60; ++i) {
    const double offset = i % 3 == 0 ? 0.0 : 1e6;
    const double unit = i % 2 == 0 ? 1.0 : 1e-6;
    const Matrix3d rotation = RandomRotation(&random);
    const Quaterniond turned(rotation);
    const Vector3d at = unit * offset * rotation.col(0);
    const double gap = i % 4 < 2 ? 1e-5 : -1e-5;
    const double x = std::sqrt(2.0) + gap;
    TriangleMesh wall = MakeBox({x, -5.1, -4.0}, {x + 1.0, 4.0, 3.7});
    for (Vector3d& v : wall.vertices) v = unit * (rotation * v) + at;
    const RigidJudge judge(Scaled(Cube(2.0), unit), wall);
    const RigidMotion motion(
        PoseAt(at, (turned * AboutZ(0.1)).normalized()),
        PoseAt(at, (turned * AboutZ(0.1 + 0.5 * kPi)).normalized()));
    const RigidCheck check = judge.Check(motion);
    EXPECT_EQ(check.outcome,
              gap > 0.0 ? MotionVerdict::kFree : MotionVerdict::kCollides)
        << i;
  }
}

// A bar that turns whole: both ends of its way are far from the post.
TEST(RigidJudge, SeesAWholeTurn) {
  const TriangleMesh bar = MakeBox({0.0, -0.01, -0.01}, {2.0, 0.01, 0.01});
  for (const double place : {0.4, 1.7, 2.9, -2.2}) {
    const auto post = [&](double radius) {
      const Vector3d p(radius * std::cos(place), radius * std::sin(place), 0.0);
      const Vector3d half(1e-4, 1e-4, 1.0);
      return MakeBox(p - half, p + half);
    };
    const RigidMotion whole = RigidMotion::Turning(
        PoseAt(Vector3d::Zero()), Vector3d::Zero(), {0.0, 0.0, 2.0 * kPi});
    const RigidCheck hit = RigidJudge(bar, post(1.9)).Check(whole);
    EXPECT_EQ(hit.outcome, MotionVerdict::kCollides);
    const double angle = place < 0.0 ? place + 2.0 * kPi : place;
    EXPECT_NEAR(hit.time, angle / (2.0 * kPi), 0.01);
    EXPECT_TRUE(RigidJudge(bar, post(2.001)).Check(whole).IsFree());
    // From pose to pose it does not turn at all.
    const RigidMotion still(PoseAt(Vector3d::Zero()), whole.end());
    EXPECT_TRUE(RigidJudge(bar, post(1.9)).Check(still).IsFree());
  }
}

TEST(RigidJudge, JudgesAPoseAsAMotionOfNoLength) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const auto check = [&](const Vector3d& q) {
    return judge
        .Check({PoseAt(q, AboutZ(0.25 * kPi)), PoseAt(q, AboutZ(0.25 * kPi))})
        .outcome;
  };
  const double edge = 1.0 + std::sqrt(2.0);
  EXPECT_EQ(check({edge + 1e-6, 0.2, 0.3}), MotionVerdict::kFree);
  EXPECT_EQ(check({edge - 1e-6, 0.2, 0.3}), MotionVerdict::kCollides);
  EXPECT_NE(check({edge, 0.2, 0.3}), MotionVerdict::kFree);
}

TEST(RigidJudge, CallsNothingFreeThatTouches) {
  const RigidJudge judge(Cube(2.0), Cube(2.0));
  const auto check = [&](const Vector3d& a, const Vector3d& b) {
    return judge.Check({PoseAt(a), PoseAt(b)});
  };
  // Faces that slide on each other, edges and corners that pass.
  EXPECT_FALSE(check({-3, 0, 2}, {3, 0.3, 2}).IsFree());
  EXPECT_FALSE(check({-3, 2, 2}, {3, 2, 2}).IsFree());
  EXPECT_FALSE(check({2, 2, -4}, {2, 2, 4}).IsFree());
  EXPECT_FALSE(check({2, 2, 5}, {2, 2, 2}).IsFree());
  EXPECT_TRUE(check({-3, 0, 2.00001}, {3, 0.3, 2.00001}).IsFree());
  // Edges that cross in one point on the way, seen in the plane.
  const RigidCheck cross = RigidJudge(Cube(2.0), Cube(2.0))
                               .Check({PoseAt({2, 0, 3}, AboutZ(0.3)),
                                       PoseAt({2, 0, 2}, AboutZ(0.3))});
  EXPECT_FALSE(cross.IsFree());
}

TEST(RigidJudge, KnowsWhoIsInsideOfWhom) {
  const TriangleMesh small = Cube(0.5), large = Cube(4.0);
  const RigidMotion motion(PoseAt({-0.5, 0, 0}),
                           PoseAt({0.5, 0, 0}, AboutZ(1.0)));
  for (const bool swap : {false, true}) {
    const RigidCheck check =
        RigidJudge(swap ? large : small, swap ? small : large).Check(motion);
    EXPECT_EQ(check.outcome, MotionVerdict::kCollides);
    EXPECT_EQ(check.robot_triangle, -1);
    EXPECT_EQ(check.time, 0.0);
    // A room: faces turned over, a box with a cavity, or one without a lid.
    TriangleMesh room = Reversed(large);
    const auto in = [&](const TriangleMesh& around) {
      return RigidJudge(swap ? around : small, swap ? small : around)
          .Check(motion)
          .outcome;
    };
    EXPECT_EQ(in(room), MotionVerdict::kFree);
    EXPECT_EQ(in(MakeBoxShell({-3, -3, -3}, {3, 3, 3}, 1.0)),
              MotionVerdict::kFree);
    room = large;
    room.triangles.pop_back();
    EXPECT_EQ(in(room), MotionVerdict::kFree);
  }
  // A part without a lid that is inside of a solid, and a sheet.
  TriangleMesh sheet = small;
  sheet.triangles.resize(1);
  EXPECT_EQ(RigidJudge(sheet, large).Check(motion).outcome,
            MotionVerdict::kCollides);
}

TEST(RigidJudge, NamesTheMeshesAndTrianglesThatMeet) {
  std::vector<TriangleMesh> robot, obstacles;
  for (int i = 0; i < 3; ++i) {
    robot.push_back(Translated(Cube(1.0), {0.0, 3.0 * i, 0.0}));
    obstacles.push_back(
        Translated(MakeUvBall(0.9, 9, 7), {4.0, 3.0 * i - 9.0, 0.0}));
  }
  // Only the first of the robot's gets to the last of the others.
  const RigidJudge judge(robot, obstacles);
  const RigidMotion motion(PoseAt(Vector3d::Zero()),
                           PoseAt({4.3, -3.0, 0.2}, AboutZ(0.1)));
  const RigidCheck check = judge.Check(motion);
  ASSERT_EQ(check.outcome, MotionVerdict::kCollides);
  EXPECT_EQ(check.robot_mesh, 0);
  EXPECT_EQ(check.obstacle_mesh, 2);
  ExpectWitness(robot[0], obstacles[2], motion, check);
}

TEST(RigidJudge, IsUndecidedWhereItMayLookNoFurther) {
  const RigidJudge judge(Cube(2.0), MakeIcoBall(1.0, 2));
  const RigidMotion motion(PoseAt({3.0, 0.0, 0.0}), PoseAt({-3.0, 2.4, 0.3}));
  const RigidCheck check = judge.Check(motion, 5);
  EXPECT_EQ(check.outcome, MotionVerdict::kUndecided);
  EXPECT_EQ(check.tests, 5);
  EXPECT_EQ(judge.Check(motion, 0).outcome, MotionVerdict::kUndecided);
  EXPECT_NE(judge.Check(motion).outcome, MotionVerdict::kUndecided);
}

TEST(RigidJudge, RefusesWhatIsNoMesh) {
  const TriangleMesh cube = Cube(1.0);
  ExpectRefused([&] { RigidJudge(TriangleMesh(), cube); },
                "rigid judge: robot: expected triangles, found none");
  ExpectRefused([&] { RigidJudge({cube}, std::vector<TriangleMesh>()); },
                "expected a mesh of the obstacle, found none");
  TriangleMesh bad = cube;
  bad.triangles[2][1] = 99;
  ExpectRefused(
      [&] {
        RigidJudge({cube}, {cube, bad});
      },
      "rigid judge: obstacle, mesh 1: expected indices of its 8 "
      "vertices, found 1 others");
  bad = cube;
  bad.vertices[3][0] = std::numeric_limits<double>::quiet_NaN();
  ExpectRefused([&] { RigidJudge(bad, cube); },
                "expected finite coordinates, found 1 vertices");
  ExpectRefused([&] { RigidJudge(Scaled(cube, 1e90), cube); }, "1e+80");
  const RigidJudge judge(cube, cube);
  ExpectRefused(
      [&] {
        judge.Check({PoseAt({1e300, 0, 0}), PoseAt({0, 0, 0})});
      },
      "expected a motion within 1e100 sizes of the meshes, found one to "
      "1e+300");
}

// Points, segments and a single triangle move, too.
TEST(RigidJudge, JudgesRobotsWithoutSize) {
  TriangleMesh point;
  point.vertices = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  point.triangles = {{0, 1, 2}};
  const RigidJudge judge(point, Cube(2.0));
  EXPECT_TRUE(
      judge.Check({PoseAt({-3, 0, 1.001}), PoseAt({3, 0, 1.001})}).IsFree());
  EXPECT_FALSE(
      judge.Check({PoseAt({-3, 0, 0.5}), PoseAt({3, 0, 0.5})}).IsFree());
  EXPECT_EQ(
      judge.Check({PoseAt({-0.3, 0, 0.5}), PoseAt({0.3, 0, 0.5})}).outcome,
      MotionVerdict::kCollides);
}

}  // namespace
}  // namespace phongpd
