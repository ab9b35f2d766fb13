// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: every lane run alone, one after the other, until it has a path.
#include "planners/rigid/rigid_race.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/stopwatch.h"
#include "planners/rigid/rigid_plan.h"
#include "planners/rigid/rigid_portfolio.h"
#include "tests/support/expect_refused.h"
#include "tests/support/rigid_paths.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::LaneSeed;
using internal::RaceEnd;
using internal::RacePortfolios;
using internal::RigidPortfolio;
using internal::RigidStop;
using internal::TreeTask;
using testing::LongBar;
using testing::WallWithHole;

using RacePath = std::vector<RobotPose>;

RigidRequest ThroughTheHole() {
  RigidRequest request;
  request.start.position = {0.2, 0.1, 2.0};
  request.goal.position = {-0.3, 0.2, -2.0};
  request.bounds = {Vector3d(-2.5, -2.5, -3.0), Vector3d(2.5, 2.5, 3.0)};
  request.time_limit = 120.0;
  return request;
}

TreeTask TaskOf(const RigidRequest& request) {
  return {request.start, request.goal, request.bounds};
}

// So tight that lanes take tenths of a second.
const TriangleMesh& TightWall() {
  static const TriangleMesh wall = MakePlateWithHole(6.0, 0.4, 1.1);
  return wall;
}

RigidWorld Wall() { return {LongBar(), TightWall()}; }
RigidWorld WholeWall() {
  return {LongBar(), MakeBox({-9, -9, -0.2}, {9, 9, 0.2})};
}

bool AreSame(const RacePath& a, const RacePath& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].position != b[i].position ||
        a[i].orientation.coeffs() != b[i].orientation.coeffs()) {
      return false;
    }
  }
  return true;
}

struct LaneAlone {
  long work, tests;
  RacePath path;
};

std::vector<LaneAlone> RunAlone(const RigidWorld& world,
                                const RigidRequest& request, int lanes) {
  std::vector<LaneAlone> alone;
  const TreeTask task = TaskOf(request);
  for (int lane = 0; lane < lanes; ++lane) {
    RigidStop stop(600.0, {});
    RigidPortfolio portfolio(world.model(), task, LaneSeed(request.seed, lane),
                             &stop);
    while (!portfolio.Grow()) {
    }
    alone.push_back({portfolio.work(), portfolio.tests(), portfolio.path()});
  }
  return alone;
}

TEST(RigidRace, IsWonByTheLaneWithTheLeastWork) {
  const RigidWorld world = Wall();
  std::set<int> winners;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    RigidRequest request = ThroughTheHole();
    request.seed = seed;
    const std::vector<LaneAlone> alone = RunAlone(world, request, 3);
    for (const int lanes : {1, 2, 3}) {
      int best = 0;
      for (int lane = 1; lane < lanes; ++lane) {
        const auto at = [&](int i) {
          return alone[static_cast<std::size_t>(i)].work;
        };
        if (at(lane) < at(best)) best = lane;
      }
      const TreeTask task = TaskOf(request);
      RigidStop stop(600.0, {});
      const RaceEnd end =
          RacePortfolios(world.model(), task, seed, lanes, &stop);
      EXPECT_EQ(end.seed, LaneSeed(seed, best));
      EXPECT_TRUE(
          AreSame(end.path, alone[static_cast<std::size_t>(best)].path));
      EXPECT_EQ(end.tests, alone[static_cast<std::size_t>(best)].tests);
      if (lanes == 3) winners.insert(best);
    }
  }
  EXPECT_GT(winners.size(), 1U);
}

// Shortened by as much work, and by the same random numbers.
TEST(RigidRace, AnswersAsOneThreadWithTheSeedOfTheWinner) {
  const RigidWorld world = Wall();
  RigidRequest request = ThroughTheHole();
  const TreeTask task = TaskOf(request);
  RigidStop stop(600.0, {});
  request.threads = 3;
  const RaceEnd end =
      RacePortfolios(world.model(), task, request.seed, 3, &stop);
  const RigidAnswer three = Plan(world, request);
  request.threads = 1;
  request.seed = end.seed;
  const RigidAnswer one = Plan(world, request);
  ASSERT_TRUE(one.IsSolved());
  EXPECT_TRUE(AreSame(three.path, one.path));
  EXPECT_EQ(three.planner, one.planner);
  EXPECT_EQ(three.found_poses, one.found_poses);
  EXPECT_EQ(three.length, one.length);
  EXPECT_EQ(three.checks, one.checks);
  EXPECT_EQ(three.tests, one.tests);
  EXPECT_EQ(three.search_tests, one.search_tests);
  EXPECT_EQ(three.nodes, one.nodes);
}

// Several plans at once on few processors: lanes stop at other moments.
TEST(RigidRace, AnswersTheSameWhateverTheLoad) {
  const RigidWorld world = Wall();
  for (const int threads : {2, 3}) {
    RigidRequest request = ThroughTheHole();
    request.threads = threads;
    const RigidAnswer first = Plan(world, request);
    ASSERT_TRUE(first.IsSolved()) << first.reason;
    testing::ExpectFreePath(LongBar(), TightWall(), request, first, 100);
    std::vector<RigidAnswer> answers(4);
    std::vector<std::thread> callers;
    for (RigidAnswer& answer : answers) {
      callers.emplace_back([&] { answer = Plan(world, request); });
    }
    for (std::thread& caller : callers) caller.join();
    for (const RigidAnswer& answer : answers) {
      EXPECT_TRUE(AreSame(answer.path, first.path)) << threads;
      EXPECT_EQ(answer.planner, first.planner);
      EXPECT_EQ(answer.tests, first.tests);
    }
  }
}

TEST(RigidRace, AsksTheCallerInItsOwnThreadAndEndsWhenItSaysSo) {
  const RigidWorld world = WholeWall();
  RigidRequest request = ThroughTheHole();
  request.threads = 4;
  int asked = 0;
  std::set<std::thread::id> who;
  request.is_interrupted = [&] {
    who.insert(std::this_thread::get_id());
    return ++asked > 300;
  };
  const Stopwatch watch;
  const RigidAnswer answer = Plan(world, request);
  EXPECT_EQ(answer.status, PathStatus::kInterrupted);
  EXPECT_EQ(asked, 301);
  EXPECT_EQ(who, std::set<std::thread::id>{std::this_thread::get_id()});
  EXPECT_LT(watch.Seconds(), 60.0);
}

TEST(RigidRace, AsksTheCallerWhileItWaitsForTheOthers) {
  // So many on few processors: some lag when lane 0 has a path or has lost.
  const RigidWorld world = Wall();
  RigidRequest request = ThroughTheHole();
  request.threads = 24;
  std::set<std::thread::id> who;
  request.is_interrupted = [&] {
    who.insert(std::this_thread::get_id());
    return false;
  };
  EXPECT_TRUE(Plan(world, request).IsSolved());
  EXPECT_EQ(who, std::set<std::thread::id>{std::this_thread::get_id()});
}

TEST(RigidRace, KeepsTheTimeLimit) {
  const RigidWorld world = WholeWall();
  RigidRequest request = ThroughTheHole();
  request.threads = 3;
  request.time_limit = 0.3;
  const RigidAnswer answer = Plan(world, request);
  EXPECT_EQ(answer.status, PathStatus::kTimeLimit);
  EXPECT_TRUE(answer.path.empty());
  EXPECT_TRUE(answer.planner.empty());
  EXPECT_GE(answer.search_seconds, 0.3);
  EXPECT_LT(answer.seconds, 10.0);
}

// The other lane is through in no time; the caller's sleeps before each of its
// few motions, and has not caught up.
TEST(RigidRace, AnswersWithThePathThatThereIsWhenTimeRunsOut) {
  const RigidWorld world(LongBar(), WallWithHole());
  RigidRequest request = ThroughTheHole();
  request.threads = 2;
  request.time_limit = 2.0;
  request.is_interrupted = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return false;
  };
  const RigidAnswer answer = Plan(world, request);
  ASSERT_TRUE(answer.IsSolved()) << answer.reason;
  EXPECT_GE(answer.search_seconds, 2.0);
  testing::ExpectFreePath(LongBar(), WallWithHole(), request, answer, 100);
}

TEST(RigidRace, ThrowsWhatTheCallerThrows) {
  const RigidWorld world = WholeWall();
  RigidRequest request = ThroughTheHole();
  request.threads = 3;
  int asked = 0;
  request.is_interrupted = [&asked]() -> bool {
    if (++asked > 200) throw std::runtime_error("enough");
    return false;
  };
  EXPECT_THROW(Plan(world, request), std::runtime_error);
}

// In a closed room, the goal outside: slides are to go as far as the judge
// refuses to look, in whichever lane comes to that first.
TEST(RigidRace, ThrowsWhatALaneThrows) {
  std::vector<TriangleMesh> room;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-3.0, 3.0}) {
      Vector3d low = Vector3d::Constant(-3.1), high = Vector3d::Constant(3.1);
      low[axis] = side - 0.1;
      high[axis] = side + 0.1;
      room.push_back(MakeBox(low, high));
    }
  }
  const RigidWorld world({LongBar()}, room);
  RigidRequest request = ThroughTheHole();
  request.start.position.setZero();
  request.goal.position = {9.0, 0.0, 0.0};
  request.bounds = {Vector3d::Constant(-1e120), Vector3d::Constant(1e120)};
  for (const int threads : {1, 3}) {
    request.threads = threads;
    testing::ExpectRefused([&] { Plan(world, request); }, "1e100");
  }
}

TEST(RigidRace, SeedsOfLanesDiffer) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    EXPECT_EQ(LaneSeed(seed, 0), seed);
    for (int lane = 0; lane < 64; ++lane) seeds.insert(LaneSeed(seed, lane));
  }
  EXPECT_EQ(seeds.size(), 6400U);
}

TEST(RigidRace, RefusesNumbersOfThreadsThatMakeNoSense) {
  const RigidWorld world = Wall();
  for (const int threads : {0, -1, 65}) {
    RigidRequest request = ThroughTheHole();
    request.threads = threads;
    testing::ExpectRefused([&] { Plan(world, request); },
                           "rigid request: threads: expected 1 to 64, found " +
                               std::to_string(threads));
  }
}

}  // namespace
}  // namespace phongpd
