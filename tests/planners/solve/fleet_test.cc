// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL at 10⁴ times for each pair.
#include "planners/solve/fleet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/fleet_problems.h"
#include "tests/support/rest_to_rest.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::CubeRobot;
using testing::RoomOfCubes;

void ExpectApart(const std::vector<FleetRobot>& robots,
                 const FleetAnswer& answer) {
  ASSERT_TRUE(answer.IsSolved()) << answer.reason;
  const CollisionOracle oracle(robots[0].world.workspace().robot,
                               robots[0].world.workspace().robot);
  int hits = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const PathAnswer& own = answer.robots[i];
    EXPECT_TRUE(own.is_solved);
    EXPECT_EQ(own.motion.At(0.0).position, robots[i].request.start);
    EXPECT_EQ(own.motion.At(answer.duration).position, robots[i].request.goal);
    EXPECT_LE(own.motion.duration(), answer.duration);
    EXPECT_TRUE(BoundLimitUse(own.motion, *robots[i].request.limits).IsKept());
    for (std::size_t k = 0; k < i; ++k) {
      for (int n = 0; n <= 10'000; ++n) {
        const double t = answer.duration * n / 10'000;
        hits += oracle.Collides(own.motion.At(t).position -
                                answer.robots[k].motion.At(t).position);
      }
    }
  }
  EXPECT_EQ(hits, 0);
}

// Robots around a circle change places with those across it.
std::vector<FleetRobot> Circle(int count, double turned = 0.1) {
  const double size = 2.0 + 0.4 * count;
  const World world = RoomOfCubes({{-size, -size, -0.05}, {size, size, 0.05}});
  std::vector<FleetRobot> robots;
  const double radius = size - 0.5;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * kPi * i / count + turned;
    const Vector3d at(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    robots.push_back(CubeRobot("robot " + std::to_string(i), world, at, -at));
  }
  return robots;
}

TEST(Fleet, RobotsChangePlacesInARoom) {
  for (const int count : {2, 4, 8}) {
    SCOPED_TRACE(count);
    const std::vector<FleetRobot> robots = Circle(count);
    double alone = 0.0, least = 0.0;
    for (const FleetRobot& robot : robots) {
      const OptimizeRequest& request = robot.request;
      alone = std::max(alone, Optimize(robot.world, request).motion.duration());
      // Each axis alone, nobody in the way.
      const double way = (request.goal - request.start).cwiseAbs().maxCoeff();
      least = std::max(least, testing::RestToRest(way, 1.0, 2.0, 10.0));
    }
    const FleetAnswer answer = OptimizeFleet(robots);
    ExpectApart(robots, answer);
    EXPECT_GE(answer.duration, least);
    EXPECT_LE(answer.duration, 1.05 * alone);
    EXPECT_LE(answer.duration, answer.by_order);
    if (count == 2) continue;  // they pass each other as if alone
    // Together all arrive at the same time, and sooner than by any order.
    EXPECT_GT(answer.rounds_together, 0);
    EXPECT_LT(answer.duration, answer.by_order);
    for (const PathAnswer& own : answer.robots) {
      EXPECT_EQ(own.motion.duration(), answer.duration);
      EXPECT_GT(own.clearance, 0.0);
      EXPECT_LT(own.motion.JointGap(2), 1e-6);
    }
    for (const FleetPair& pair : answer.pairs) EXPECT_GT(pair.clearance, 0.0);
  }
}

// How much sooner than one after the other: of one circle rounding decides,
// which is as symmetric as they come, so several are turned otherwise.
TEST(Fleet, ArrivesSoonerTogetherThanByOrder) {
  double together = 0.0, by_order = 0.0;
  for (int k = 0; k < 6; ++k) {
    const FleetAnswer answer = OptimizeFleet(Circle(4, 0.1 + 0.25 * k));
    EXPECT_LT(answer.duration, answer.by_order) << k;
    together += answer.duration;
    by_order += answer.by_order;
  }
  EXPECT_LT(together, 0.95 * by_order);
}

// Limits of the norm are proved of what is made faster together, too.
TEST(Fleet, IsMadeFasterTogetherWithinLimitsOfTheNorm) {
  std::vector<FleetRobot> robots = Circle(4);
  for (FleetRobot& robot : robots) robot.request.limits->by_norm = true;
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectApart(robots, answer);
  EXPECT_GT(answer.rounds_together, 0);
  EXPECT_LT(answer.duration, answer.by_order);
}

// One that stays does so while the others are made faster around it.
TEST(Fleet, IsMadeFasterAroundWhoStays) {
  std::vector<FleetRobot> robots = Circle(6);
  robots.push_back(CubeRobot("stays", robots[0].world, {0, 0, 0}, {0, 0, 0}));
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectApart(robots, answer);
  EXPECT_GT(answer.rounds_together, 0);
  EXPECT_LT(answer.duration, answer.by_order);
  for (const double t : {0.0, 0.3, 0.7, 1.0}) {
    EXPECT_EQ(answer.robots[6].motion.At(t * answer.duration).position,
              Vector3d(0, 0, 0));
  }
}

// The second one stands in the first one's way and has to leave before it
// comes; the corridor has no room to pass.
TEST(Fleet, GoesInAnotherOrderWhereTheFirstOneFails) {
  const World world = RoomOfCubes({{-9, -0.02, -0.02}, {9, 0.02, 0.02}});
  // The first would rest at 2, which is on the second's way to 6.
  const std::vector<FleetRobot> robots = {
      CubeRobot("behind", world, {-3, 0, 0}, {2, 0, 0}),
      CubeRobot("ahead", world, {-1, 0, 0}, {6, 0, 0})};
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectApart(robots, answer);
  const std::vector<FleetRobot> turned = {
      CubeRobot("left", world, {-6, 0, 0}, {6, 0, 0}),
      CubeRobot("right", world, {6, 0, 0}, {-6, 0, 0})};
  const FleetAnswer none = OptimizeFleet(turned);
  EXPECT_FALSE(none.IsSolved());
  EXPECT_GE(none.tries, 2);
  EXPECT_EQ(none.duration, 0.0);  // not all arrive
  EXPECT_NE(none.reason.find("no motion was found"), std::string::npos)
      << none.reason;
}

// One that stays is kept off, whatever the order.
TEST(Fleet, KeepsOffRobotsThatStay) {
  const World world = RoomOfCubes({{-6, -3, -0.05}, {6, 3, 0.05}});
  const std::vector<FleetRobot> robots = {
      CubeRobot("moves", world, {-5, 0, 0}, {5, 0, 0}),
      CubeRobot("stays", world, {0, 0, 0}, {0, 0, 0})};
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectApart(robots, answer);
  EXPECT_EQ(answer.order, (std::vector<std::size_t>{1, 0}));
}

TEST(Fleet, RefusesRobotsThatBeginOrEndInEachOther) {
  const World world = RoomOfCubes({{-9, -9, -9}, {9, 9, 9}});
  const auto message = [&](const Vector3d& start, const Vector3d& goal,
                           const std::string& name) -> std::string {
    return testing::ErrorOf([&] {
      OptimizeFleet({CubeRobot("one", world, {0, 0, 0}, {5, 0, 0}),
                     CubeRobot(name, world, start, goal)});
    });
  };
  EXPECT_NE(message({0.5, 0, 0}, {0, 5, 0}, "two").find("at their starts"),
            std::string::npos);
  EXPECT_NE(message({0, 5, 0}, {5, 0.5, 0}, "two").find("at their goals"),
            std::string::npos);
  EXPECT_NE(message({0, 5, 0}, {0, 0, 5}, "one").find("\"one\" twice"),
            std::string::npos);
  EXPECT_EQ(world.Report().contact_spaces, 0);
  FleetRobot slow = CubeRobot("slow", world, {0, 0, 0}, {5, 0, 0});
  slow.request.limits.reset();
  EXPECT_THROW(OptimizeFleet({slow}), InputError);
}

// The pair's numbers against distances of boxes by hand.
TEST(Fleet, TellsOfEachPairHowCloseItComes) {
  const std::vector<FleetRobot> robots = Circle(3);
  const FleetAnswer answer = OptimizeFleet(robots);
  ASSERT_TRUE(answer.IsSolved()) << answer.reason;
  ASSERT_EQ(answer.pairs.size(), 3u);
  double closest = 1e9;
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = i + 1; k < 3; ++k) {
      const FleetPair& pair = answer.pairs[at++];
      EXPECT_EQ(pair.first, robots[i].name);
      EXPECT_EQ(pair.second, robots[k].name);
      EXPECT_TRUE(pair.is_free);
      EXPECT_FALSE(pair.verification);
      const auto room = [&](double t) {
        return ((answer.robots[i].motion.At(t).position -
                 answer.robots[k].motion.At(t).position)
                    .cwiseAbs() -
                Vector3d::Ones())
            .cwiseMax(0.0)
            .norm();
      };
      double least = 1e9;
      for (int n = 0; n <= 10'000; ++n) {
        least = std::min(least, room(answer.duration * n / 10'000));
      }
      EXPECT_GT(least, 0.0);
      EXPECT_NEAR(pair.least, least, 0.02 * least + 1e-6);
      EXPECT_NEAR(room(pair.time), pair.least, 1e-9);
      EXPECT_LE(pair.clearance, least);
      EXPECT_GE(pair.clearance, 0.5 * least);
      closest = std::min(closest, pair.least);
    }
  }
  ASSERT_NE(answer.Closest(), nullptr);
  EXPECT_EQ(answer.Closest()->least, closest);
}

TEST(Fleet, IsJudgedOnTheSolidsAsWell) {
  std::vector<FleetRobot> robots = Circle(2);
  for (FleetRobot& robot : robots) robot.request.verifies = true;
  const FleetAnswer answer = OptimizeFleet(robots);
  ASSERT_TRUE(answer.IsSolved()) << answer.reason;
  ASSERT_TRUE(answer.pairs[0].verification);
  EXPECT_EQ(answer.pairs[0].verification->verdict, Verdict::kConfirmed);
}

// One that stays cannot keep off what comes to it.
TEST(Fleet, HasNoMotionWhereSomethingComesToARobotThatStays) {
  const World world = RoomOfCubes({{-9, -9, -0.05}, {9, 9, 0.05}});
  std::vector<FleetRobot> robots = {
      CubeRobot("moves", world, {-5, 5, 0}, {5, 5, 0}),
      CubeRobot("stays", world, {0, 0, 0}, {0, 0, 0})};
  const MovingObstacle cart = {
      MakeSolid(testing::Cube(1.0), "cart"),
      Trajectory({CurvePiece({-8, 0, 0}, {8, 0, 0}, 4.0)})};
  for (FleetRobot& robot : robots) robot.request.moving = {cart};
  const FleetAnswer answer = OptimizeFleet(robots);
  EXPECT_FALSE(answer.IsSolved());
  // At −1, 7 of 16 on the way.
  EXPECT_NE(answer.reason.find("\"stays\": it stays where the moving obstacle "
                               "\"cart\" comes at t = 1.75"),
            std::string::npos)
      << answer.reason;
  EXPECT_EQ(answer.tries, 0);
}

// Others lose less by giving way to the one that sets the time.
TEST(Fleet, LetsTheSlowestAloneGoFirst) {
  const World world = RoomOfCubes({{-9, -9, -0.05}, {9, 9, 0.05}});
  std::vector<FleetRobot> robots = {
      CubeRobot("near", world, {-2, 0, 0}, {2, 0, 0}),
      CubeRobot("far", world, {0, -6, 0}, {0, 6, 0}),
      CubeRobot("middle", world, {-4, 2, 0}, {4, 2, 0})};
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectApart(robots, answer);
  EXPECT_EQ(answer.tries, 1);
  EXPECT_EQ(answer.order, (std::vector<std::size_t>{1, 2, 0}));
  // It goes as if it were alone, and the others are done before it.
  const double alone =
      Optimize(robots[1].world, robots[1].request).motion.duration();
  EXPECT_EQ(answer.duration, alone);
  // More orders only where they could make it sooner.
  for (FleetRobot& robot : robots) robot.request.preset = Preset::kTight;
  EXPECT_EQ(OptimizeFleet(robots).tries, 1);
}

// What more orders find is certified, and no later than the first.
TEST(Fleet, TriesMoreOrdersForASoonerEnd) {
  std::vector<FleetRobot> robots = Circle(3);
  // With a place on the way they do not all turn the same way instead.
  robots[0].request.via = {{0.5 * robots[0].request.start}};
  const FleetAnswer first = OptimizeFleet(robots);
  ASSERT_EQ(first.tries, 1);
  // The last one's preset counts for the orders, and its own motion alone.
  robots.back().request.preset = Preset::kBalanced;
  const FleetAnswer more = OptimizeFleet(robots);
  ExpectApart(robots, more);
  EXPECT_EQ(more.tries, 2);
  ASSERT_EQ(more.pairs.size(), 3u);
  EXPECT_LE(more.duration, 1.05 * first.duration);
}

TEST(Fleet, RefusesWhatOtherRobotsLeaveNoRoomFor) {
  const World world = RoomOfCubes({{-9, -9, -0.05}, {9, 9, 0.05}});
  const std::vector<FleetRobot> good = {
      CubeRobot("one", world, {0, 0, 0}, {5, 0, 0}),
      CubeRobot("two", world, {0, 5, 0}, {5, 5, 0})};
  std::vector<FleetRobot> robots = good;
  robots[1].request.duration = 9.0;
  EXPECT_THROW(OptimizeFleet(robots), InputError);
  robots = good;
  robots[0].request.arrival.velocity = {0.1, 0, 0};
  EXPECT_THROW(OptimizeFleet(robots), InputError);
}

}  // namespace
}  // namespace phongpd
