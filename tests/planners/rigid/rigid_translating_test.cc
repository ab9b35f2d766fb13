// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exact judge of translations (motion_oracle.h), which shares no
// test of triangles with that of motions that turn; holes that can only be
// passed, or not, as the robot is turned.
#include <gtest/gtest.h>

#include <string>

#include "constraints/motion_oracle.h"
#include "planners/rigid/rigid_plan.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/rigid_paths.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::Cube;
using testing::ExpectRefused;
using testing::LongBar;
using testing::WallWithHole;

RigidRequest Between(const Vector3d& start, const Vector3d& goal,
                     const Quaterniond& turn = Quaterniond::Identity()) {
  RigidRequest request;
  request.start = {start, turn};
  request.goal = {goal, turn};
  request.time_limit = 60.0;
  return request;
}

void ExpectTranslates(const TriangleMesh& robot, const TriangleMesh& obstacle,
                      const RigidRequest& request, const RigidAnswer& answer) {
  ASSERT_EQ(answer.status, PathStatus::kSolved) << answer.reason;
  testing::ExpectFreePath(robot, obstacle, request, answer, 50);
  TriangleMesh turned = robot;
  for (Vector3d& v : turned.vertices) v = request.start.orientation * v;
  const MotionOracle oracle(MakeSolid(turned, "robot"),
                            MakeSolid(obstacle, "obstacle"));
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    const RobotPose &from = answer.path[i], &to = answer.path[i + 1];
    EXPECT_FALSE(oracle.Collides(from.position, to.position)) << i;
    EXPECT_EQ(to.orientation.coeffs(), request.start.orientation.coeffs()) << i;
  }
}

TEST(RigidPlanWithoutTurning, KeepsItsTurnBitForBit) {
  const TriangleMesh robot = MakeBox({-0.3, -0.1, -0.1}, {0.3, 0.1, 0.1});
  const TriangleMesh obstacle = MakeU(2.0, 0.2, 1.0);
  for (const double angle : {0.0, 0.7, 3.0}) {
    const Quaterniond turn(
        Eigen::AngleAxisd(angle, Vector3d(1.0, 2.0, -0.5).normalized()));
    RigidRequest request = Between({0.1, -3.0, 0.5}, {0.2, 3.0, 0.4}, turn);
    for (request.seed = 1; request.seed <= 5; ++request.seed) {
      const RigidAnswer answer = PlanWithoutTurning({robot, obstacle}, request);
      ExpectTranslates(robot, obstacle, request, answer);
    }
  }
}

// Of a hole of 0.4 a cube of 0.37 leaves little.
TEST(RigidPlanWithoutTurning, GoesThroughATightHole) {
  const TriangleMesh robot = Cube(0.37),
                     obstacle = MakePlateWithHole(2, 0.2, 0.4);
  RigidRequest request = Between({0.5, 0.4, 1.0}, {-0.4, 0.3, -1.0});
  request.bounds = {Vector3d(-0.6, -0.6, -1.5), Vector3d(0.6, 0.6, 1.5)};
  for (request.seed = 1; request.seed <= 2; ++request.seed) {
    const RigidAnswer answer = PlanWithoutTurning({robot, obstacle}, request);
    ExpectTranslates(robot, obstacle, request, answer);
  }
}

TEST(RigidPlanWithoutTurning, FindsNothingWhereItWouldHaveToTurn) {
  RigidRequest request = Between({0.2, 0.1, 2.0}, {-0.3, 0.2, -2.0});
  request.bounds = {Vector3d(-1.5, -1.5, -3.0), Vector3d(1.5, 1.5, 3.0)};
  const RigidWorld world(LongBar(), WallWithHole());
  EXPECT_EQ(Plan(world, request).status, PathStatus::kSolved);
  request.time_limit = 0.5;
  const RigidAnswer answer = PlanWithoutTurning(world, request);
  EXPECT_EQ(answer.status, PathStatus::kTimeLimit);
  EXPECT_TRUE(answer.path.empty());
}

// A pane without thickness bounds no solid.
TEST(RigidPlanWithoutTurning, GoesAroundAnOpenSurface) {
  const TriangleMesh pane{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}},
                          {{0, 1, 2}, {0, 2, 3}}};
  const RigidRequest request = Between({0.0, 0.0, 0.5}, {0.1, 0.0, -0.5});
  const RigidAnswer answer = PlanWithoutTurning({Cube(0.2), pane}, request);
  ASSERT_EQ(answer.status, PathStatus::kSolved) << answer.reason;
  testing::ExpectFreePath(Cube(0.2), pane, request, answer, 50);
}

TEST(RigidPlanWithoutTurning, RefusesAGoalThatIsTurned) {
  RigidRequest request = Between({0.0, 0.0, 2.0}, {0.0, 0.0, -2.0});
  request.goal.orientation = Quaterniond(0.0, 0.0, 0.0, 1.0);
  ExpectRefused(
      [&] {
        PlanWithoutTurning({Cube(0.2), Cube(1.0)}, request);
      },
      "goal: expected to be turned as the start, found");
}

}  // namespace
}  // namespace phongpd
