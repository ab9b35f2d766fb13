// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: OptimizeCurve along each path by itself.
#include "planners/solve/best_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "planners/solve/plan.h"
#include "tests/support/staged.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::BestCurve;
using internal::OptimizeAlongBest;
using testing::Staged;

// A thin plate in the way, and two ways past it that differ: to its side, which
// is shorter, and over it, which is faster with limits of every axis; and a
// copy of the first, a little off.
struct TwoWays {
  TwoWays() : staged("plate:seed=4") {
    PlanRequest request;
    request.start = staged.scene.start;
    request.goal = staged.scene.goal;
    request.routes = 3;
    const PathAnswer plan = Plan(staged.world, request);
    space = plan.evidence.free_space;
    double fastest = std::numeric_limits<double>::infinity();
    for (const Path& route : plan.plan->routes) {
      const double seconds = Alone(route).duration;
      if (seconds < fastest) fast = route;
      fastest = std::min(fastest, seconds);
    }
    slow = plan.path;
    alike = slow;
    for (std::size_t i = 1; i + 1 < alike.size(); ++i) {
      alike[i] += Vector3d::Constant(1e-3 * staged.world.diagonal());
    }
  }

  CurveOptions Options() const {
    CurveOptions options;
    options.limits.velocity.setConstant(1.0);
    options.limits.acceleration.setConstant(2.0);
    options.limits.jerk.setConstant(8.0);
    return options;
  }
  CurveSummary Alone(const Path& path) const {
    return OptimizeCurve(*space, staged.world.diagonal(), path, Options());
  }
  BestCurve Best(const std::vector<Path>& paths, const CurveOptions& options,
                 bool margin_is_required = false, int refined = 1) const {
    return OptimizeAlongBest(*space, staged.world.diagonal(), paths, options,
                             margin_is_required, refined);
  }

  Staged staged;
  std::shared_ptr<const FreeSpace> space;
  Path slow, fast, alike;
};

TEST(BestCurve, RefinesTheWayThatProvesFasterAsIfItWereAlone) {
  const TwoWays ways;
  const CurveSummary slow = ways.Alone(ways.slow), fast = ways.Alone(ways.fast);
  ASSERT_LT(fast.duration, 0.9 * slow.duration);
  for (const bool fast_first : {false, true}) {
    const BestCurve best =
        fast_first ? ways.Best({ways.fast, ways.slow}, ways.Options())
                   : ways.Best({ways.slow, ways.fast}, ways.Options());
    EXPECT_EQ(best.path, fast_first ? 0u : 1u);
    EXPECT_EQ(best.summary.duration, fast.duration);
    EXPECT_EQ(best.summary.rounds.size(), fast.rounds.size());
    EXPECT_EQ(best.summary.clearance, fast.clearance);
  }
}

// What is missing of a wish has its price, whichever way comes first: no way
// wins by a margin that is worth less than the time it takes.
TEST(BestCurve, TakesTheWayOfTheLeastCost) {
  const TwoWays ways;
  const double diagonal = ways.staged.world.diagonal();
  for (const double share : {1e-4, 0.01, 0.2}) {
    CurveOptions options = ways.Options();
    options.margin = share * diagonal;
    double least = std::numeric_limits<double>::infinity();
    for (const Path& path : {ways.slow, ways.fast}) {
      const CurveSummary one =
          OptimizeCurve(*ways.space, diagonal, path, options);
      least = std::min(least, one.cost);
      // All of it is missing at the most.
      EXPECT_GE(one.cost, one.duration);
      EXPECT_LE(one.cost, one.duration * (1.0 + 50.0 * share));
      if (one.margin == options.margin) {
        EXPECT_EQ(one.cost, one.duration);
      }
    }
    const BestCurve a = ways.Best({ways.slow, ways.fast}, options, false, 2);
    const BestCurve b = ways.Best({ways.fast, ways.slow}, options, false, 2);
    EXPECT_EQ(a.summary.cost, least) << share;
    EXPECT_EQ(b.summary.cost, least) << share;
  }
}

TEST(BestCurve, LeavesOutWhatIsHardlyAnotherWay) {
  const TwoWays ways;
  const BestCurve best = ways.Best({ways.slow, ways.alike}, ways.Options());
  EXPECT_EQ(best.tried, 1);
  EXPECT_EQ(best.summary.duration, ways.Alone(ways.slow).duration);
}

TEST(BestCurve, LeavesOutWhatIsTooLongToBeAsFast) {
  const TwoWays ways;
  Path detour = ways.slow;
  detour.insert(detour.begin() + 1, ways.slow[0] + Vector3d(0, 0, 100.0));
  detour.insert(detour.begin() + 2, ways.slow[0]);
  const BestCurve best = ways.Best({ways.slow, detour}, ways.Options());
  EXPECT_EQ(best.tried, 1);
}

// Straight to the goal: no way is faster, whatever it is.
TEST(BestCurve, LooksAtNoOtherWayWhereOneIsNearTheLeastTime) {
  const TwoWays ways;
  const Vector3d start = ways.slow.front(), up = start + Vector3d(0, 0, 0.1);
  const BestCurve best = ways.Best(
      {{start, up}, {start, up + Vector3d(0.2, 0, 0), up}}, ways.Options());
  EXPECT_EQ(best.tried, 1);
}

// A way of many corners is not compared, and one after it is, which has fewer.
TEST(BestCurve, ComparesNoWayOfManyCorners) {
  const TwoWays ways;
  Path many = {ways.fast.front()};
  for (std::size_t i = 1; i < ways.fast.size(); ++i) {
    const Vector3d from = many.back();
    for (int k = 1; k <= 20; ++k) {
      many.push_back(from + k / 20.0 * (ways.fast[i] - from));
    }
  }
  ASSERT_GT(many.size(), 32u);
  const std::vector<Path> paths = {ways.slow, many, ways.fast};
  const BestCurve best = ways.Best(paths, ways.Options());
  EXPECT_EQ(best.path, 2u);
  EXPECT_EQ(best.tried, 2);
  EXPECT_EQ(ways.Best({ways.slow, many}, ways.Options()).tried, 1);
  // Whoever asks for several gets them.
  EXPECT_EQ(ways.Best(paths, ways.Options(), false, 2).tried, 3);
}

TEST(BestCurve, TakesTheFirstWaysWhereTimeIsNotWhatCounts) {
  const TwoWays ways;
  CurveOptions options = ways.Options();
  options.margin = 1e-3 * ways.staged.world.diagonal();
  EXPECT_EQ(ways.Best({ways.slow, ways.fast}, options, true).path, 0u);
  options.margin = 0.0;
  options.duration = 10.0;
  const BestCurve calm = ways.Best({ways.slow, ways.fast}, options);
  EXPECT_EQ(calm.path, 0u);
  EXPECT_EQ(calm.tried, 1);
}

// The first way has its first curve even so.
TEST(BestCurve, HasACurveHoweverShortTheTime) {
  const TwoWays ways;
  CurveOptions options = ways.Options();
  options.time_limit = 1e-9;
  const BestCurve best = ways.Best({ways.slow, ways.fast}, options);
  EXPECT_EQ(best.path, 0u);
  EXPECT_FALSE(best.summary.trajectory.empty());
  EXPECT_EQ(best.summary.status, PathStatus::kTimeLimit);
}

// A way that is not free loses against one that is, wherever it stands.
TEST(BestCurve, NeverAnswersAlongAWayThatIsNotFree) {
  const TwoWays ways;
  const Path through = {ways.slow.front(), ways.slow.back()};
  ASSERT_FALSE(CheckPath(*ways.space, through).free);
  EXPECT_EQ(ways.Best({through, ways.slow}, ways.Options()).path, 1u);
  EXPECT_EQ(ways.Best({ways.slow, through}, ways.Options()).path, 0u);
}

TEST(SquaredJerk, IsTheIntegralOfAParabolasSquare) {
  // x = t³/6 for a second, then y = t⁵/60 for two: jerks 1 and t².
  const double h = 2.0, c = h * h * h * h * h / 60.0;
  const Trajectory motion({CurvePiece({Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero(),
                                       {1.0 / 6.0, 0, 0}},
                                      1.0),
                           CurvePiece({{1.0 / 6.0, 0, 0},
                                       {1.0 / 6.0, 0, 0},
                                       {1.0 / 6.0, 0, 0},
                                       {1.0 / 6.0, 0, 0},
                                       {1.0 / 6.0, 0, 0},
                                       {1.0 / 6.0, c, 0}},
                                      h)});
  MotionLimits limits;
  limits.jerk = {2.0, 1.0, 1.0};
  // ∫ (1/2)² + ∫ t⁴ = 1/4 + h⁵/5
  EXPECT_NEAR(internal::SquaredJerk(motion, limits),
              0.25 + std::pow(h, 5) / 5.0, 1e-12);
}

}  // namespace
}  // namespace phongpd
