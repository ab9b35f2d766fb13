// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed worlds whose answer is known, and the robot placed by another
// route at many moments of the path, in CGAL's exact kernel.
#include "planners/rigid/rigid_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/pi.h"
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
using testing::MeshDistance;
using testing::PlacedMesh;
using testing::WallWithHole;

RobotPose At(const Vector3d& position, double angle = 0.0,
             const Vector3d& axis = Vector3d::UnitZ()) {
  RobotPose pose;
  pose.position = position;
  pose.orientation = Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
  return pose;
}

bool IsSame(const RobotPose& a, const RobotPose& b) {
  return a.position == b.position &&
         a.orientation.coeffs() == b.orientation.coeffs();
}

void ExpectFreePath(const TriangleMesh& robot, const TriangleMesh& obstacle,
                    const RigidRequest& request, const RigidAnswer& answer) {
  ASSERT_EQ(answer.status, PathStatus::kSolved) << answer.reason;
  testing::ExpectFreePath(robot, obstacle, request, answer, 200);
  // It is as close as it says where it says so, and nowhere closer.
  const RigidClearance& clearance = answer.clearance;
  EXPECT_GT(clearance.lower, 0.0);
  EXPECT_TRUE(clearance.is_resolved);
  const auto from = static_cast<std::size_t>(clearance.motion);
  ASSERT_LT(from + 1, answer.path.size());
  const RigidMotion closest(answer.path[from], answer.path[from + 1]);
  const double distance =
      MeshDistance(PlacedMesh(robot, closest, clearance.time), obstacle);
  EXPECT_GE(distance, clearance.lower);
  EXPECT_LE(distance, clearance.upper);
}

RigidRequest ThroughTheWall() {
  RigidRequest request;
  request.start = At({0.2, 0.1, 2.0});
  request.goal = At({-0.3, 0.2, -2.0}, 0.4, {0.0, 1.0, 1.0});
  request.bounds = {Vector3d(-2.5, -2.5, -3.0), Vector3d(2.5, 2.5, 3.0)};
  request.time_limit = 60.0;
  return request;
}

TEST(RigidPlan, GoesStraightWhereNothingIsInTheWay) {
  const TriangleMesh robot = LongBar(), obstacle = Cube(1.0);
  RigidRequest request;
  request.start = At({-3.0, 3.0, 0.0});
  request.goal = At({3.0, 3.0, 0.0}, 2.0);
  const RigidAnswer answer = Plan({robot, obstacle}, request);
  ExpectFreePath(robot, obstacle, request, answer);
  EXPECT_EQ(answer.planner, "line");
  EXPECT_EQ(answer.path.size(), 2u);
  // Of a box by area about its middle: ∫ |p|² over its six faces.
  const double faces[3] = {2 * 0.4 * 2.0, 2 * 0.4 * 2.0, 2 * 0.4 * 0.4};
  const double a = 1.0 / 3.0, b = 0.04 / 3.0;
  const double square = (faces[0] * (a + b + 0.04) + faces[1] * (a + b + 0.04) +
                         faces[2] * (2 * b + 1.0)) /
                        (faces[0] + faces[1] + faces[2]);
  EXPECT_NEAR(answer.length, std::sqrt(36.0 + 4.0 * square), 1e-12);
}

TEST(RigidPlan, GoesAroundABlock) {
  const TriangleMesh robot = LongBar(), obstacle = Cube(2.0);
  RigidRequest request;
  request.start = At({-3.0, 0.0, 0.0});
  request.goal = At({3.0, 0.0, 0.0}, 0.5 * kPi);
  request.time_limit = 60.0;
  const RigidAnswer answer = Plan({robot, obstacle}, request);
  ExpectFreePath(robot, obstacle, request, answer);
  // Short: not twice as long as straight through the block.
  EXPECT_LT(answer.length, 2.0 * 6.3);
}

TEST(RigidPlan, TurnsABarThroughAHole) {
  for (const std::uint64_t seed : {1, 2}) {
    RigidRequest request = ThroughTheWall();
    request.seed = seed;
    const RigidAnswer answer = Plan({LongBar(), WallWithHole()}, request);
    ExpectFreePath(LongBar(), WallWithHole(), request, answer);
    EXPECT_LE(answer.path.size(), 60u);
  }
}

TEST(RigidPlan, ShorteningLeavesAShorterPath) {
  RigidRequest request = ThroughTheWall();
  const RigidAnswer short_one = Plan({LongBar(), WallWithHole()}, request);
  request.shortens = false;
  const RigidAnswer as_found = Plan({LongBar(), WallWithHole()}, request);
  ExpectFreePath(LongBar(), WallWithHole(), request, as_found);
  EXPECT_EQ(as_found.path.size(), as_found.found_poses);
  EXPECT_EQ(as_found.found_poses, short_one.found_poses);
  EXPECT_LT(short_one.length, as_found.length);
}

// Where there is room the first of the race finds a path before any other
// begins, and what follows is cut short with the work, not with the clock.
TEST(RigidPlan, SolvesAnEasyWorldByStraightMotionsWithLittleWork) {
  const TriangleMesh wall = MakePlateWithHole(16.0, 0.5, 4.0);
  TriangleMesh robot = MakeL(2.0, 0.5, 0.5);
  for (Vector3d& v : robot.vertices) v -= Vector3d(1.0, 1.0, 0.25);
  const RigidWorld world(robot, wall);
  RigidRequest request;
  request.start = At({2.0, 2.0, 3.0}, 1.0, Vector3d::UnitX());
  request.goal = At({-2.0, 1.0, -3.0}, 2.0, Vector3d::UnitY());
  request.bounds = {Vector3d::Constant(-5.0), Vector3d::Constant(5.0)};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    request.seed = seed;
    request.shortens = true;
    const RigidAnswer answer = Plan(world, request);
    ASSERT_TRUE(answer.IsSolved()) << answer.reason;
    EXPECT_EQ(answer.planner, "straight");
    EXPECT_LT(answer.search_tests, 20'000) << seed;
    EXPECT_LT(answer.nodes, 100) << seed;
    // Shortening by 20,000 and a cut, the second pass and the clearance.
    EXPECT_LT(answer.tests - answer.search_tests, 50'000) << seed;
    request.shortens = false;
    const RigidAnswer as_found = Plan(world, request);
    EXPECT_EQ(as_found.search_tests, answer.search_tests);
    EXPECT_LT(answer.length, as_found.length);
  }
}

TEST(RigidPlan, CountsNoMoreThanTheLineWhereItIsFree) {
  RigidRequest request;
  request.start = At({-3.0, 3.0, 0.0});
  request.goal = At({3.0, 3.0, 0.0}, 2.0);
  const RigidWorld world(LongBar(), Cube(1.0));
  const RigidAnswer answer = Plan(world, request);
  ASSERT_EQ(answer.planner, "line");
  // Start, goal, the motion, and the motion once more at the end.
  EXPECT_EQ(answer.checks, 4);
  EXPECT_EQ(answer.nodes, 0);
  long tests = 0;
  for (const RigidMotion& motion : {RigidMotion(request.start, request.start),
                                    RigidMotion(request.goal, request.goal),
                                    RigidMotion(request.start, request.goal)}) {
    tests += world.judge().Check(motion).tests;
  }
  EXPECT_EQ(answer.search_tests, tests);
}

TEST(RigidPlan, GivesTheSamePathForTheSameSeed) {
  const RigidRequest request = ThroughTheWall();
  const RigidWorld world(LongBar(), WallWithHole());
  const RigidAnswer one = Plan(world, request), other = Plan(world, request);
  ASSERT_TRUE(one.IsSolved());
  EXPECT_EQ(one.planner, other.planner);
  EXPECT_EQ(one.tests, other.tests);
  ASSERT_EQ(one.path.size(), other.path.size());
  for (std::size_t i = 0; i < one.path.size(); ++i) {
    EXPECT_TRUE(IsSame(one.path[i], other.path[i])) << i;
  }
}

// (1 − t) z + t z is not always z.
TEST(RigidPlan, StaysWithinBoundsOfNoWidth) {
  const RigidWorld world(LongBar(), Cube(2.0));
  RigidRequest request;
  request.start = At({-3.0, 0.1, 0.1});
  request.goal = At({3.0, 0.1, 0.1});
  request.bounds = {Vector3d(-4.0, -4.0, 0.1), Vector3d(4.0, 4.0, 0.1)};
  for (request.seed = 1; request.seed <= 8; ++request.seed) {
    const RigidAnswer answer = Plan(world, request);
    ASSERT_TRUE(answer.IsSolved()) << answer.reason;
    EXPECT_GT(answer.path.size(), 2u);
    for (const RobotPose& pose : answer.path) {
      EXPECT_TRUE(request.bounds.contains(pose.position)) << request.seed;
    }
  }
}

TEST(RigidPlan, SaysThatNoneWasFoundThroughAWholeWall) {
  const TriangleMesh wall = MakeBox({-9, -9, -0.2}, {9, 9, 0.2});
  RigidRequest request = ThroughTheWall();
  request.time_limit = 0.3;
  const RigidAnswer answer = Plan({LongBar(), wall}, request);
  EXPECT_EQ(answer.status, PathStatus::kTimeLimit);
  EXPECT_TRUE(answer.path.empty());
  EXPECT_TRUE(answer.planner.empty());
  EXPECT_NE(answer.reason.find("does not prove"), std::string::npos);
  EXPECT_EQ(answer.length, 0.0);
  EXPECT_GT(answer.checks, 0);
}

TEST(RigidPlan, EndsWhenTheCallerSaysSo) {
  const TriangleMesh wall = MakeBox({-9, -9, -0.2}, {9, 9, 0.2});
  RigidRequest request = ThroughTheWall();
  int asked = 0;
  request.is_interrupted = [&asked] { return ++asked > 100; };
  const RigidAnswer answer = Plan({LongBar(), wall}, request);
  EXPECT_EQ(answer.status, PathStatus::kInterrupted);
  EXPECT_TRUE(answer.path.empty());
  EXPECT_EQ(asked, 101);
}

TEST(RigidPlan, TellsWhoMeetsWhomAndHowDeep) {
  RigidRequest request;
  request.start = At({1.4, 0.0, 0.0});
  request.goal = At({5.0, 0.0, 0.0});
  const RigidWorld world(Cube(1.0), Cube(2.0));
  RigidAnswer answer = Plan(world, request);
  EXPECT_EQ(answer.status, PathStatus::kStartInCollision);
  ASSERT_TRUE(answer.depth.has_value());
  EXPECT_NEAR(*answer.depth, 0.1, 1e-9);
  EXPECT_GE(answer.collision.robot_triangle, 0);
  EXPECT_NE(answer.reason.find("0.1 deep"), std::string::npos) << answer.reason;
  std::swap(request.start, request.goal);
  answer = Plan(world, request);
  EXPECT_EQ(answer.status, PathStatus::kGoalInCollision);
  EXPECT_NE(answer.reason.find("the goal"), std::string::npos);
  // Touching is not decided, which is not free.
  request.start = At({1.5, 0.0, 0.0});
  EXPECT_EQ(Plan(world, request).status, PathStatus::kStartInCollision);
}

TEST(RigidPlan, TellsWhichEndIsOutOfBounds) {
  RigidRequest request = ThroughTheWall();
  request.bounds.max().z() = 1.5;
  const RigidWorld world(LongBar(), WallWithHole());
  EXPECT_EQ(Plan(world, request).status, PathStatus::kStartOutOfBounds);
  std::swap(request.start, request.goal);
  EXPECT_EQ(Plan(world, request).status, PathStatus::kGoalOutOfBounds);
}

TEST(RigidPlan, RefusesRequestsThatMakeNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RigidWorld world(LongBar(), WallWithHole());
  const auto expect = [&](const auto& change, const std::string& part) {
    RigidRequest request = ThroughTheWall();
    change(&request);
    ExpectRefused([&] { Plan(world, request); }, part);
  };
  for (const double limit : {0.0, -1.0, nan, 2e9}) {
    expect([&](RigidRequest* r) { r->time_limit = limit; }, "time_limit");
  }
  expect([](RigidRequest* r) { r->start.orientation.w() = 2.0; }, "start");
  expect([&](RigidRequest* r) { r->goal.position.x() = nan; }, "goal");
  expect([](RigidRequest* r) { r->bounds.max().x() = -4.0; }, "bounds");
  expect([&](RigidRequest* r) { r->bounds.min().y() = nan; }, "bounds");
}

TEST(RigidWorld, RefusesARobotWithoutAnySize) {
  const TriangleMesh point{{Vector3d::Zero()}, {{0, 0, 0}}};
  ExpectRefused([&] { RigidWorld(point, Cube(1.0)); }, "some size");
  ExpectRefused([&] { RigidWorld(TriangleMesh{}, Cube(1.0)); }, "robot");
}

}  // namespace
}  // namespace phongpd
