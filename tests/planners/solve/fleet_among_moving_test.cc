// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: FCL at 10⁴ times for each pair, places and rests counted at those
// times, and the motions by order, which are never sooner.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "planners/solve/fleet.h"
#include "problems/shapes/shapes.h"
#include "tests/support/fleet_problems.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

constexpr int kTimes = 10'000;

World Hall(double height = 0.05) {
  return testing::RoomOfCubes({{-7, -5, -height}, {7, 5, height}});
}

// Judged on the solids, too.
FleetRobot Robot(const std::string& name, const World& world,
                 const Vector3d& start, const Vector3d& goal) {
  FleetRobot robot = testing::CubeRobot(name, world, start, goal);
  robot.request.verifies = true;
  return robot;
}

// Of robots with each other and with what moves, until all rest.
int Hits(const std::vector<FleetRobot>& robots, const FleetAnswer& answer) {
  const Solid& cube = robots[0].world.workspace().robot;
  double end = answer.duration;
  for (const MovingObstacle& body : robots[0].request.moving) {
    end = std::max(end, body.motion.duration());
  }
  int hits = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Trajectory& own = answer.robots[i].motion;
    const auto count = [&](const Solid& solid, const Trajectory& other) {
      const CollisionOracle oracle(cube, solid);
      for (int n = 0; n <= kTimes; ++n) {
        const double t = end * n / kTimes;
        hits += oracle.Collides(own.At(t).position - other.At(t).position);
      }
    };
    for (std::size_t k = 0; k < i; ++k) count(cube, answer.robots[k].motion);
    for (const MovingObstacle& body : robots[i].request.moving) {
      count(body.solid, body.motion);
    }
  }
  return hits;
}

// Certified, on the solids as well, within the limits, and sooner than by
// order.
void ExpectSooner(const std::vector<FleetRobot>& robots,
                  const FleetAnswer& answer) {
  ASSERT_TRUE(answer.IsSolved()) << answer.reason;
  EXPECT_GT(answer.rounds_together, 0);
  EXPECT_LT(answer.duration, answer.by_order);
  EXPECT_EQ(Hits(robots, answer), 0);
  for (const FleetPair& pair : answer.pairs) {
    EXPECT_TRUE(pair.is_free) << pair.first << " " << pair.second;
    EXPECT_GT(pair.clearance, 0.0);
    ASSERT_TRUE(pair.verification);
    EXPECT_EQ(pair.verification->verdict, Verdict::kConfirmed);
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Trajectory& own = answer.robots[i].motion;
    EXPECT_EQ(own.At(0.0).position, robots[i].request.start);
    EXPECT_EQ(own.At(answer.duration).position, robots[i].request.goal);
    EXPECT_TRUE(BoundLimitUse(own, *robots[i].request.limits).IsKept());
    EXPECT_LT(own.JointGap(2), 1e-6);
  }
}

MovingObstacle Part(const Trajectory& motion, double length = 2.0) {
  return {
      MakeSolid(MakeBox({-0.5 * length, -0.5, -0.5}, {0.5 * length, 0.5, 0.5}),
                "part"),
      motion};
}

// A conveyor's part goes along a lane that all have to cross.
TEST(FleetAmongMoving, CrossesALaneWithAPartOnIt) {
  const World world = Hall();
  std::vector<FleetRobot> robots = {
      Robot("up", world, {-1, -4, 0}, {-1, 4, 0}),
      Robot("down", world, {1, 4, 0}, {1, -4, 0}),
      Robot("across", world, {-3, -3, 0}, {3, 3, 0})};
  for (FleetRobot& robot : robots) {
    robot.request.moving = {
        Part(Trajectory({CurvePiece({-6, 0, 0}, {6, 0, 0}, 8.0)}))};
  }
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectSooner(robots, answer);
  ASSERT_EQ(answer.pairs.size(), 6u);
}

// One that stops, turns and comes back, by pieces of several degrees.
TEST(FleetAmongMoving, KeepsOffAPartThatTurnsBack) {
  const World world = Hall();
  std::vector<FleetRobot> robots = {
      Robot("up", world, {0, -4, 0}, {0, 4, 0}),
      Robot("down", world, {2, 4, 0}, {-2, -4, 0})};
  const Vector3d a(-5, 0, 0), b(2, 0, 0), c(4, 1, 0);
  for (FleetRobot& robot : robots) {
    robot.request.moving = {
        Part(Trajectory({CurvePiece(a, b, 3.7),
                         CurvePiece(std::vector<Vector3d>{b, c, c, b}, 2.1),
                         CurvePiece(b, a, 5.3)}))};
  }
  ExpectSooner(robots, OptimizeFleet(robots));
}

// How often of the times a motion is so near a place, in a row at most; and
// where the first of those is.
std::pair<int, int> TimesNear(const Trajectory& motion, const Vector3d& place,
                              double distance, int from = 0) {
  int most = 0, row = 0, at = -1;
  for (int n = from; n <= kTimes; ++n) {
    const double t = motion.duration() * n / kTimes;
    const bool is_near = (motion.At(t).position - place).norm() <= distance;
    row = is_near ? row + 1 : 0;
    if (is_near && at < 0) at = n;
    most = std::max(most, row);
  }
  return {most, at};
}

// Two that meet in the middle, each by a place that it passes and one to rest
// at.
TEST(FleetAmongMoving, PassesPlacesOnTheWay) {
  const World world = Hall();
  std::vector<FleetRobot> robots = {
      Robot("right", world, {-5, 0, 0}, {5, 1.5, 0}),
      Robot("left", world, {5, 0, 0}, {-5, -1.5, 0})};
  constexpr double kDwell = 0.7;
  for (const int i : {0, 1}) {
    const double side = i == 0 ? 1.0 : -1.0;
    robots[i].request.via = {
        {{-2.0 * side, -side, 0}, Length::FromUnit(0.1), 0.0},
        {{side, 0, 0}, Length::FromUnit(0.1), kDwell}};
  }
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectSooner(robots, answer);
  // What a step between two times can be off.
  const double step = 2.0 * answer.duration / kTimes;
  for (const int i : {0, 1}) {
    const Trajectory& own = answer.robots[i].motion;
    const auto& via = robots[i].request.via;
    const auto [passed, first] = TimesNear(own, via[0].point, 0.1 + step);
    EXPECT_GE(passed, 1);
    const auto [rested, second] = TimesNear(own, via[1].point, 0.0, first);
    EXPECT_GT(second, first);
    EXPECT_GE((rested + 1) * answer.duration / kTimes, kDwell);
  }
}

// Twice at one place, one rest after the other, and at the goal.
TEST(FleetAmongMoving, RestsTwiceAndAtTheGoal) {
  const World world = Hall();
  std::vector<FleetRobot> robots = {
      Robot("right", world, {-5, 0, 0}, {5, 1.5, 0}),
      Robot("left", world, {5, 0, 0}, {-5, -1.5, 0})};
  const Length near = Length::FromUnit(0.1);
  robots[0].request.via = {
      {{-2, -1, 0}, near, 0.0}, {{1, 0, 0}, near, 0.3}, {{1, 0, 0}, near, 0.4}};
  robots[1].request.via = {{{2, 1, 0}, near, 0.0}, {{-5, -1.5, 0}, near, 0.5}};
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectSooner(robots, answer);
  const double rests[] = {0.7, 0.5};
  for (const int i : {0, 1}) {
    const Vector3d& place = robots[i].request.via.back().point;
    const auto [rested, first] =
        TimesNear(answer.robots[i].motion, place, 1e-12);
    EXPECT_GE(first, 0);
    EXPECT_GE((rested + 1) * answer.duration / kTimes, rests[i]);
  }
}

// All at once: places, a part on its way, and one that stays.
TEST(FleetAmongMoving, PassesPlacesAmongWhatMoves) {
  const World world = Hall();
  std::vector<FleetRobot> robots = {
      Robot("up", world, {-1, -4, 0}, {-1, 4, 0}),
      Robot("down", world, {0.5, 4, 0}, {0.5, -4, 0}),
      Robot("stays", world, {4, -3, 0}, {4, -3, 0})};
  robots[0].request.via = {{{0, -2, 0}, Length::FromUnit(0.1), 0.0}};
  robots[1].request.via = {{{0, 2, 0}, Length::FromUnit(0.1), 0.0}};
  for (FleetRobot& robot : robots) {
    robot.request.moving = {
        Part(Trajectory({CurvePiece({-6, 0, 0}, {6, 0, 0}, 9.0)}))};
  }
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectSooner(robots, answer);
  const double step = 2.0 * answer.duration / kTimes;
  for (const int i : {0, 1}) {
    const Vector3d& place = robots[i].request.via[0].point;
    EXPECT_GE(TimesNear(answer.robots[i].motion, place, 0.1 + step).first, 1);
  }
}

// A margin that is required is kept from all, by distances of boxes.
TEST(FleetAmongMoving, KeepsAMarginThatIsRequired) {
  const World world = Hall(0.4);
  std::vector<FleetRobot> robots = {
      Robot("right", world, {-5, 0, 0}, {5, 0.3, 0}),
      Robot("left", world, {5, -0.3, 0}, {-5, 0, 0}),
      Robot("up", world, {0.4, -4, 0}, {0, 4, 0})};
  constexpr double kMargin = 0.3;
  for (FleetRobot& robot : robots) {
    robot.request.margin = Length::FromUnit(kMargin);
    robot.request.requires_margin = true;
  }
  const FleetAnswer answer = OptimizeFleet(robots);
  ExpectSooner(robots, answer);
  double least = 1e9;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      for (int n = 0; n <= kTimes; ++n) {
        const double t = answer.duration * n / kTimes;
        least = std::min(least, ((answer.robots[i].motion.At(t).position -
                                  answer.robots[k].motion.At(t).position)
                                     .cwiseAbs() -
                                 Vector3d::Ones())
                                    .cwiseMax(0.0)
                                    .norm());
      }
    }
  }
  EXPECT_GE(least, kMargin);
}

}  // namespace
}  // namespace phongpd
