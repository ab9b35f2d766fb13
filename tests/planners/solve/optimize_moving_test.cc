// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of crossings, FCL at 10⁴ times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "constraints/oracle/collision_oracle.h"
#include "core/mesh/mesh_error.h"
#include "planners/solve/optimize.h"
#include "problems/shapes/shapes.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_problems.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

Solid Box(const std::string& name, const Vector3d& low, const Vector3d& high) {
  return MakeSolid(MakeBox(low, high), name);
}

Solid CubeNamed(const std::string& name, double side = 1.0) {
  return MakeSolid(Cube(side), name);
}

Trajectory Straight(const Vector3d& from, const Vector3d& to, double seconds) {
  return Trajectory({CurvePiece(from, to, seconds)});
}

// A cube of side 1 that can do little but go along x from −8 to 8.
Workspace Corridor() {
  Workspace workspace;
  workspace.robot = CubeNamed("robot");
  workspace.bounds = {{-9.0, -0.01, -0.01}, {9.0, 0.01, 0.01}};
  return workspace;
}

OptimizeRequest Along(const Vector3d& start, const Vector3d& goal) {
  OptimizeRequest request;
  request.start = start;
  request.goal = goal;
  request.margin = Length::FromUnit(0.001);
  request.preset = Preset::kFast;
  request.limits = testing::PlainLimits();
  return request;
}

// FCL at so many times, until all have come to rest.
int Hits(const Workspace& workspace, const OptimizeRequest& request,
         const Trajectory& motion, int times = 10'000) {
  double end = motion.duration();
  for (const MovingObstacle& one : request.moving) {
    end = std::max(end, one.motion.duration());
  }
  std::vector<CollisionOracle> fixed, moving;
  for (const Solid& obstacle : workspace.obstacles) {
    fixed.emplace_back(workspace.robot, obstacle);
  }
  for (const MovingObstacle& one : request.moving) {
    moving.emplace_back(workspace.robot, one.solid);
  }
  int hits = 0;
  for (int i = 0; i <= times; ++i) {
    const double t = end * i / times;
    const Vector3d q = motion.At(t).position;
    for (const CollisionOracle& oracle : fixed) hits += oracle.Collides(q);
    for (std::size_t k = 0; k < moving.size(); ++k) {
      hits += moving[k].Collides(q - request.moving[k].motion.At(t).position);
    }
  }
  return hits;
}

void ExpectCertifiedAmong(const World& world, const OptimizeRequest& request,
                          const PathAnswer& answer) {
  ASSERT_TRUE(answer.is_solved) << answer.reason;
  EXPECT_TRUE(answer.is_free);
  EXPECT_TRUE(answer.evidence.use.IsKept());
  EXPECT_LE(answer.motion.JointGap(1), 1e-9);
  EXPECT_LE(answer.motion.JointGap(2), 1e-7);
  EXPECT_EQ(answer.motion.At(0.0).position, request.start);
  EXPECT_EQ(answer.motion.At(answer.motion.duration()).position, request.goal);
  EXPECT_EQ(Hits(world.workspace(), request, answer.motion), 0);
  if (request.verifies) {
    EXPECT_LE(answer.evidence.verification->verdict, Verdict::kWithinRounding)
        << answer.evidence.verification->reason;
  }
}

// When the motion is at x for the first time.
double TimeAt(const Trajectory& motion, double x) {
  double low = 0.0, high = motion.duration();
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (motion.At(middle).position[0] < x ? low : high) = middle;
  }
  return low;
}

// Contact while |x| ≤ 1 and |z| ≤ 1; the cube comes down the z axis at speed w
// and is there from `from` on.
MovingObstacle Crossing(double from, double w) {
  constexpr double kFar = 20.0;
  const double seconds = 2.0 * kFar / w, top = 1.0 + w * from;
  return {CubeNamed("cube"),
          Straight({0, 0, top}, {0, 0, top - 2.0 * kFar}, seconds)};
}

TEST(OptimizeAmongMoving, WaitsNoLongerThanTheCrossingTakes) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  const PathAnswer alone = Optimize(world, request);
  ASSERT_TRUE(alone.is_solved) << alone.reason;
  // At full speed it is on x ∈ [−1, 1] between these times.
  const double enters = TimeAt(alone.motion, -1.0);
  const double leaves = TimeAt(alone.motion, 1.0);
  for (const double w : {0.3, 0.7, 2.0}) {
    request.moving = {Crossing(0.5 * (enters + leaves), w)};
    const PathAnswer answer = Optimize(world, request);
    SCOPED_TRACE(w);
    ExpectCertifiedAmong(world, request, answer);
    // It may not be at x = −1 before the cube has gone, but for what it gives
    // way in z, and there is no faster way to the goal than at full speed and
    // at rest by the largest jerk.
    const double gone = 0.5 * (enters + leaves) + 1.98 / w;
    const double least = gone + 9.0 + 0.35;
    EXPECT_GE(TimeAt(answer.motion, -1.0), gone);
    EXPECT_GE(answer.motion.duration(), least);
    EXPECT_LE(answer.motion.duration(), 1.02 * least);
  }
}

TEST(OptimizeAmongMoving, GoesFirstWhereThereIsTime) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  const PathAnswer alone = Optimize(world, request);
  const double leaves = TimeAt(alone.motion, 1.0);
  request.moving = {Crossing(leaves + 0.1, 0.2)};
  const PathAnswer answer = Optimize(world, request);
  ExpectCertifiedAmong(world, request, answer);
  EXPECT_EQ(answer.motion.duration(), alone.motion.duration());
  EXPECT_LT(TimeAt(answer.motion, 1.0), leaves + 0.1);
}

// Two crossings: between the first and the second it has to hurry or to stop.
TEST(OptimizeAmongMoving, FindsItsTurnBetweenTwoCrossings) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  MovingObstacle first = Crossing(4.0, 0.5), second = Crossing(10.0, 0.5);
  const auto moved = [](const MovingObstacle& one, const std::string& name,
                        double x) -> MovingObstacle {
    const CurvePiece& piece = one.motion.pieces()[0];
    const Vector3d by(x, 0, 0);
    return {one.solid.Named(name),
            Straight(piece.front() + by, piece.back() + by, piece.duration())};
  };
  request.moving = {moved(first, "first", -4.0), moved(second, "second", 4.0)};
  const PathAnswer answer = Optimize(world, request);
  ExpectCertifiedAmong(world, request, answer);
  EXPECT_EQ(world.Report().contact_spaces, 1);
}

TEST(OptimizeAmongMoving, SaysThatNothingWasFoundWhereNothingIs) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  // Comes through all of the corridor, which has room for one.
  request.moving = {{CubeNamed("cart"), Straight({7, 0, 5}, {7, 0, 0}, 2.0)}};
  const Trajectory down = request.moving[0].motion;
  std::vector<CurvePiece> pieces = down.pieces();
  pieces.emplace_back(Vector3d(7, 0, 0), Vector3d(-12, 0, 0), 20.0);
  request.moving[0].motion = Trajectory(pieces);
  const PathAnswer answer = Optimize(world, request);
  EXPECT_EQ(answer.status, PathStatus::kFailed);
  EXPECT_FALSE(answer.is_free || answer.is_solved);
  EXPECT_TRUE(answer.motion.empty());
  EXPECT_NE(answer.reason.find("\"cart\" at t = "), std::string::npos)
      << answer.reason;
}

// The same with a bay beside the corridor, where there is room to let it pass.
TEST(OptimizeAmongMoving, MakesWayInABay) {
  Workspace workspace;
  workspace.robot = CubeNamed("robot");
  workspace.bounds = {{-9, -0.02, -0.02}, {9, 2.5, 0.02}};
  // All of y > 0.02 is wall but for x ∈ [−3, −0.5] of q.
  workspace.obstacles = {Box("wall 1", {-9.6, 0.52, -0.6}, {-3.5, 3.2, 0.6}),
                         Box("wall 2", {0.5, 0.52, -0.6}, {9.6, 3.2, 0.6})};
  const World world(workspace);
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  request.moving = {
      {CubeNamed("cart"), Straight({9, 0, 0}, {-13, 0, 0}, 22.0)}};
  // Nobody on the goal when it is over.
  const PathAnswer answer = Optimize(world, request);
  ExpectCertifiedAmong(world, request, answer);
  double highest = 0.0;
  for (const Trajectory::Sample& at : answer.motion.Samples(100.0)) {
    highest = std::max(highest, at.position[1]);
  }
  EXPECT_GT(highest, 1.0);
}

// A goal that is swept is reached afterwards.
TEST(OptimizeAmongMoving, ArrivesWhenTheGoalIsNoLongerSwept) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {0, 0, 0});
  request.moving = {Crossing(20.0, 0.5)};  // until 24
  const PathAnswer answer = Optimize(world, request);
  ExpectCertifiedAmong(world, request, answer);
  EXPECT_GT(answer.motion.duration(), 23.9);
  EXPECT_LT(answer.motion.duration(), 26.5);
}

// Comes to rest in front of the goal, 0.1 away: half of what is required.
TEST(OptimizeAmongMoving, SaysThatItIsTheMarginThatCannotBeKept) {
  Workspace hall = Corridor();
  hall.bounds = {{-9, -9, -1}, {9, 9, 1}};
  const World world(hall);
  OptimizeRequest request = Along({-4, 0, 0}, {4, 0, 0});
  request.moving = {{CubeNamed("cart"), Straight({0, 0, 0}, {2.9, 0, 0}, 2.0)}};
  request.margin = Length::FromUnit(0.2);
  request.requires_margin = true;
  const PathAnswer none = Optimize(world, request);
  EXPECT_FALSE(none.is_solved);
  EXPECT_EQ(
      none.reason.rfind("no motion was found that keeps off what moves by "
                        "the margin required; the fastest without it "
                        "meets \"cart\" at t = ",
                        0),
      0u)
      << none.reason;
  request.requires_margin = false;
  const PathAnswer near = Optimize(world, request);
  ExpectCertifiedAmong(world, request, near);
  EXPECT_LE(near.clearance, 0.1);
}

TEST(OptimizeAmongMoving, SaysBeforeItBuildsWhatCannotBe) {
  const World world(Corridor());
  OptimizeRequest request = Along({-8, 0, 0}, {8, 0, 0});
  const auto with = [&](const MovingObstacle& one) {
    request.moving = {one};
    return Optimize(world, request);
  };
  const PathAnswer at_start =
      with({CubeNamed("cart"), Straight({-7.5, 0, 0}, {0, 0, 9}, 3.0)});
  EXPECT_EQ(at_start.status, PathStatus::kStartInCollision);
  EXPECT_NE(at_start.reason.find("\"cart\" is there at t = 0"),
            std::string::npos)
      << at_start.reason;
  const PathAnswer at_goal =
      with({CubeNamed("cart"), Straight({0, 0, 9}, {8.5, 0, 0}, 3.0)});
  EXPECT_EQ(at_goal.status, PathStatus::kGoalInCollision);
  EXPECT_NE(at_goal.reason.find("comes to rest there, at t = 3"),
            std::string::npos)
      << at_goal.reason;
  EXPECT_THROW(with({CubeNamed("cart"), Trajectory()}), InputError);
  EXPECT_THROW(with({Solid(), Straight({0, 0, 9}, {0, 0, 0}, 3.0)}),
               InputError);
  const MovingObstacle good = {CubeNamed("cart"),
                               Straight({0, 0, 9}, {0, 0, -9}, 3.0)};
  request.duration = 30.0;
  EXPECT_THROW(with(good), InputError);
  request.duration = 0.0;
  request.departure.velocity[0] = 0.1;
  EXPECT_THROW(with(good), InputError);
  request.departure.velocity[0] = 0.0;
  request.limits.reset();
  EXPECT_THROW(with(good), InputError);
  request.limits = testing::PlainLimits();
  request.moving = {good, good};
  EXPECT_THROW(Optimize(world, request), InputError);
  EXPECT_EQ(world.Report().contact_spaces, 0);
}

// Rooms of boxes with one to three things that fly across, hover and turn back.
TEST(OptimizeAmongMoving, IsCertifiedOrSaysNotFoundOnRandomInstances) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&](double size) -> Vector3d {
    return size * Vector3d(unit(random), unit(random), 0.3 * unit(random));
  };
  long solved = 0, tried = 0;
  std::vector<double> ratios;
  const long cases = testing::CampaignCases(60, 400);
  for (int i = 0; tried < cases; ++i) {
    Workspace workspace;
    workspace.robot = CubeNamed("robot", 0.8);
    workspace.bounds = {{-6, -6, -1}, {6, 6, 1}};
    for (int k = 0; k < 4; ++k) {
      const Vector3d at = point(4.5), size(0.5 + 0.4 * unit(random), 0.9, 2.0);
      workspace.obstacles.push_back(
          Box("box " + std::to_string(k), at - size, at + size));
    }
    const World world(workspace);
    OptimizeRequest request = Along(point(5.5), point(5.5));
    request.verifies = i % 10 == 0;
    for (int k = 0; k <= i % 3; ++k) {
      std::vector<CurvePiece> pieces;
      Vector3d at = point(6.0);
      for (int n = 0; n < 3; ++n) {
        const Vector3d to = point(7.0);
        pieces.emplace_back(std::vector<Vector3d>{at, at, to, to},
                            3.0 + unit(random));
        at = to;
      }
      request.moving.push_back(
          {CubeNamed("flyer " + std::to_string(k), 0.9), Trajectory(pieces)});
    }
    OptimizeRequest without = request;
    without.moving.clear();
    const PathAnswer alone = Optimize(world, without);
    if (!alone.is_solved) continue;
    const PathAnswer answer = Optimize(world, request);
    if (answer.status == PathStatus::kStartInCollision ||
        answer.status == PathStatus::kGoalInCollision) {
      EXPECT_NE(answer.reason.find("flyer"), std::string::npos);
      continue;
    }
    ++tried;
    SCOPED_TRACE(i);
    if (!answer.is_solved) {
      EXPECT_EQ(answer.status, PathStatus::kFailed);
      EXPECT_NE(answer.reason.find("no motion was found"), std::string::npos);
      EXPECT_TRUE(answer.motion.empty());
      continue;
    }
    ++solved;
    ExpectCertifiedAmong(world, request, answer);
    ratios.push_back(answer.motion.duration() / alone.motion.duration());
  }
  EXPECT_GE(solved, 9 * tried / 10);
  // Waiting is not forced in most of them.
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LE(ratios[ratios.size() / 2], 1.02);
  EXPECT_LE(ratios[ratios.size() * 8 / 10], 1.3);
}

}  // namespace
}  // namespace phongpd
