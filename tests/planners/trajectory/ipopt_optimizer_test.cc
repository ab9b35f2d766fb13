// SPDX-License-Identifier: GPL-3.0-or-later
// Paths are judged here by FreeSpace's exact segments, and by closed forms.
#include "planners/trajectory/ipopt_optimizer.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/trap.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Trap;

// Straight through both arms of the U, shifted at random.
TrajectoryProblem TrapProblem(unsigned seed, MetricKind metric) {
  SignedMetricOptions options;
  options.metric = metric;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-0.15, 0.15);
  const double x = uniform(random), z = uniform(random);
  return testing::TrapProblem({x, -1.95, z}, {x, 1.95, z}, options);
}

void ExpectEvidence(const TrajectoryProblem& problem,
                    const TrajectorySummary& summary) {
  EXPECT_EQ(summary.path.size(),
            static_cast<std::size_t>(problem.waypoints) + 2);
  EXPECT_EQ(summary.path.front(), problem.start);
  EXPECT_EQ(summary.path.back(), problem.goal);
  EXPECT_EQ(summary.collision_free,
            CheckPath(*problem.free_space, summary.path).free);
  EXPECT_TRUE(std::isfinite(summary.objective));
  EXPECT_TRUE(std::isfinite(summary.violation));
  EXPECT_TRUE(std::isfinite(summary.dual_infeasibility));
  for (const IterationRecord& record : summary.log) {
    EXPECT_TRUE(std::isfinite(record.objective));
    EXPECT_TRUE(std::isfinite(record.violation));
    EXPECT_TRUE(std::isfinite(record.dual_infeasibility));
  }
}

// The claim of the paper, from colliding straight lines.  Monotone mu is
// where the difference is largest; with adaptive mu Euclid catches up.
TEST(IpoptTrajectoryOptimizer, PhongLeavesATrapWhereEuclidIsCaught) {
  TrajectoryOptions options;
  options.ipopt.mu_strategy = IpoptSettings::MuStrategy::kMonotone;
  options.ipopt.stall_iterations = 0;
  options.max_rounds = 1;
  int solved[2] = {0, 0};
  for (unsigned seed = 0; seed < 6; ++seed) {
    for (const MetricKind kind : {MetricKind::kPhong, MetricKind::kEuclidean}) {
      const TrajectoryProblem problem = TrapProblem(seed, kind);
      ASSERT_FALSE(problem.free_space->IsFree(problem.start, problem.goal));
      const TrajectorySummary summary =
          IpoptTrajectoryOptimizer(problem, options).Solve();
      ExpectEvidence(problem, summary);
      const int i = kind == MetricKind::kPhong ? 0 : 1;
      solved[i] += summary.IsSolved() ? 1 : 0;
    }
  }
  EXPECT_EQ(solved[0], 6);
  EXPECT_LE(solved[1], 3);
}

TEST(IpoptTrajectoryOptimizer, KeepsTheMarginAndTheLengths) {
  const TrajectoryProblem problem = TrapProblem(3, MetricKind::kPhong);
  const TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
  ASSERT_TRUE(summary.IsSolved());
  const double diagonal = Diagonal(problem);
  const double h = MaxSegment(problem, 0.0);
  EXPECT_LT(h / (summary.samples[0] + 1), 2.0 * problem.margin * diagonal);
  for (std::size_t i = 0; i + 1 < summary.path.size(); ++i) {
    EXPECT_LT((summary.path[i + 1] - summary.path[i]).norm(), h * (1 + 1e-6));
    if (i > 0) {
      EXPECT_GT(problem.free_space->Clearance(summary.path[i]),
                (problem.margin - 1e-6) * diagonal);
    }
  }
  EXPECT_GT(PathClearance(*problem.free_space, summary.path),
            0.3 * problem.margin * diagonal);
  EXPECT_GT(summary.objective, 1.0);
  EXPECT_GT(summary.queries.warm + summary.queries.cold, 0);
}

TEST(IpoptTrajectoryOptimizer, GivesTheSameBytesEveryTime) {
  const TrajectoryProblem problem = TrapProblem(1, MetricKind::kPhong);
  const IpoptTrajectoryOptimizer optimizer(problem);
  const TrajectorySummary a = optimizer.Solve(), b = optimizer.Solve();
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.objective, b.objective);
  const TrajectorySummary c =
      IpoptTrajectoryOptimizer(TrapProblem(1, MetricKind::kPhong)).Solve();
  EXPECT_EQ(a.path, c.path);
}

TEST(IpoptTrajectoryOptimizer, IsTheSameInEveryUnit) {
  const TrajectoryProblem problem = TrapProblem(2, MetricKind::kPhong);
  const TrajectorySummary a = IpoptTrajectoryOptimizer(problem).Solve();
  for (const double scale : {1.0 / 1024.0, 1024.0}) {
    TrajectoryProblem scaled =
        MakeTrajectoryProblem({TakeAsContactSpace(Scaled(Trap(), scale))});
    scaled.start = scale * problem.start;
    scaled.goal = scale * problem.goal;
    const TrajectorySummary b = IpoptTrajectoryOptimizer(scaled).Solve();
    EXPECT_EQ(a.iterations, b.iterations);
    for (std::size_t i = 0; i < a.path.size(); ++i) {
      EXPECT_EQ(scale * a.path[i], b.path[i]);
    }
  }
}

TEST(IpoptTrajectoryOptimizer, FindsAWayOutOfATrap) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    const TrajectoryProblem problem = TrapProblem(seed, MetricKind::kPhong);
    const TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
    ExpectEvidence(problem, summary);
    EXPECT_TRUE(summary.IsSolved());
    EXPECT_GT(summary.queries.warm, 0);
  }
}

TEST(IpoptTrajectoryOptimizer, PassesBetweenSeveralObstacles) {
  std::vector<ContactSpace> obstacles;
  for (int i = 0; i < 4; ++i) {
    const double side = i % 2 == 0 ? 0.25 : -0.25;
    obstacles.push_back(TakeAsContactSpace(Rotated(
        Translated(MakeIcoBall(0.4, 2), {i - 1.5, side, 0.1 * i - 0.15}),
        GenericRotation())));
  }
  TrajectoryProblem problem = MakeTrajectoryProblem(obstacles);
  problem.start = GenericRotation() * Vector3d(-2.5, 0, 0);
  problem.goal = GenericRotation() * Vector3d(2.5, 0, 0);
  ASSERT_FALSE(problem.free_space->IsFree(problem.start, problem.goal));
  const TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
  ExpectEvidence(problem, summary);
  EXPECT_TRUE(summary.IsSolved());
  EXPECT_LT(summary.objective, 1.1);
}

TEST(IpoptTrajectoryOptimizer, StaysWithinBounds) {
  TrajectoryProblem problem = TrapProblem(1, MetricKind::kPhong);
  const IpoptTrajectoryOptimizer free(problem);
  // A slab that leaves only the way round the far ends.
  Vector3d low = problem.start.cwiseMin(problem.goal);
  Vector3d high = problem.start.cwiseMax(problem.goal);
  low.array() -= 1.2;
  high.array() += 1.2;
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(Trap())},
      BoundingBox{low, high});
  const TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
  EXPECT_TRUE(summary.IsSolved());
  for (const Vector3d& p : summary.path) {
    EXPECT_TRUE((p.array() > low.array()).all());
    EXPECT_TRUE((p.array() < high.array()).all());
  }
}

// Waypoint rows alone are jumped over; the judge sees it, and more samples
// where it crosses repair it.
TEST(IpoptTrajectoryOptimizer, RefinesSegmentsThatCross) {
  int crossed = 0, repaired = 0;
  for (unsigned seed = 0; seed < 4; ++seed) {
    TrajectoryProblem problem = TrapProblem(seed, MetricKind::kPhong);
    problem.margin = 0.002;
    ASSERT_GT(SamplesPerSegment(problem, 0.0), 5);  // by the rule
    problem.samples_per_segment = 1;
    TrajectoryOptions options;
    options.max_rounds = 1;
    const TrajectorySummary one =
        IpoptTrajectoryOptimizer(problem, options).Solve();
    ExpectEvidence(problem, one);
    if (one.collision_free) continue;
    ++crossed;
    EXPECT_TRUE(IsClassOk(one.status));
    EXPECT_FALSE(one.IsSolved());
    EXPECT_GE(one.first_crossing.segment, 0);
    options.max_rounds = 6;
    const TrajectorySummary many =
        IpoptTrajectoryOptimizer(problem, options).Solve();
    ExpectEvidence(problem, many);
    EXPECT_GT(many.rounds, 1);
    repaired += many.IsSolved() ? 1 : 0;
  }
  EXPECT_GT(crossed, 0);
  EXPECT_GT(repaired, 0);
}

TEST(IpoptTrajectoryOptimizer, NamesEndsInCollision) {
  TrajectoryProblem problem = TrapProblem(0, MetricKind::kPhong);
  const Vector3d inside = GenericRotation() * Vector3d(-0.9, 0.0, 0.0);
  ASSERT_FALSE(problem.free_space->IsFree(inside));
  const Vector3d start = problem.start;
  problem.start = inside;
  TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
  EXPECT_EQ(summary.status, SolveStatus::kInvalidStart);
  EXPECT_FALSE(summary.IsSolved());
  ExpectEvidence(problem, summary);
  problem.start = start;
  problem.goal = inside;
  summary = IpoptTrajectoryOptimizer(problem).Solve();
  EXPECT_EQ(summary.status, SolveStatus::kInvalidGoal);
  EXPECT_STREQ(ToString(summary.status), "invalid_goal");
  ExpectEvidence(problem, summary);
}

TEST(IpoptTrajectoryOptimizer, NeedsNoSolverWhereThereIsNothingToDo) {
  TrajectoryProblem problem = TrapProblem(0, MetricKind::kPhong);
  problem.goal = problem.start;
  TrajectorySummary summary = IpoptTrajectoryOptimizer(problem).Solve();
  EXPECT_TRUE(summary.IsSolved());
  EXPECT_EQ(summary.iterations, 0);
  EXPECT_EQ(summary.objective, 0.0);
  ExpectEvidence(problem, summary);
  TrajectoryProblem empty = MakeTrajectoryProblem({});
  empty.goal = Vector3d(1, 2, 3);
  summary = IpoptTrajectoryOptimizer(empty).Solve();
  EXPECT_TRUE(summary.IsSolved());
  EXPECT_NEAR(summary.objective, 1.0, 1e-12);
  ExpectEvidence(empty, summary);
}

TEST(IpoptTrajectoryOptimizer, StopsAtTheLimits) {
  const TrajectoryProblem problem = TrapProblem(0, MetricKind::kPhong);
  TrajectoryOptions options;
  options.ipopt.max_iterations = 3;
  options.max_rounds = 1;
  TrajectorySummary summary =
      IpoptTrajectoryOptimizer(problem, options).Solve();
  EXPECT_EQ(summary.status, SolveStatus::kIterationLimit);
  EXPECT_FALSE(summary.IsSolved());
  ExpectEvidence(problem, summary);
  options = {};
  options.ipopt.time_limit = 1e-6;
  summary = IpoptTrajectoryOptimizer(problem, options).Solve();
  EXPECT_EQ(summary.status, SolveStatus::kTimeLimit);
  EXPECT_EQ(summary.rounds, 1);
  // A tick of the processor's clock may be as long as several of them.
  EXPECT_LT(summary.iterations, 20);
  options = {};
  options.ipopt.on_iteration = [](const IterationRecord&,
                                  const Eigen::VectorXd&) { return false; };
  summary = IpoptTrajectoryOptimizer(problem, options).Solve();
  EXPECT_EQ(summary.status, SolveStatus::kCancelled);
  EXPECT_EQ(summary.rounds, 1);
  ExpectEvidence(problem, summary);
}

// Free paths that no longer improve come back as such: on a torus the solver
// cycles between feasible iterates.
TEST(IpoptTrajectoryOptimizer, StallReturnsAFreePathUnderItsOwnStatus) {
  TrajectoryProblem problem = MakeTrajectoryProblem({TakeAsContactSpace(
      Rotated(MakeTorus(0.8, 0.3, 32, 16), GenericRotation()))});
  TrajectoryOptions options;
  options.ipopt.stall_iterations = 5;
  options.rows = 3;
  int stalled = 0;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 6; ++i) {
    Vector3d d;
    do {
      for (double& x : d) x = normal(random);
      d.normalize();
      problem.start = 1.6 * d + Vector3d(0.1, 0.05, 0.0);
      problem.goal = -1.6 * d + Vector3d(0.1, 0.05, 0.0);
    } while (problem.free_space->IsFree(problem.start, problem.goal));
    const TrajectorySummary summary =
        IpoptTrajectoryOptimizer(problem, options).Solve();
    ExpectEvidence(problem, summary);
    EXPECT_TRUE(summary.IsSolved()) << ToString(summary.status);
    if (summary.status != SolveStatus::kStalledFeasible) continue;
    ++stalled;
    EXPECT_EQ(summary.raw_status, "User_Requested_Stop");
    EXPECT_LE(summary.violation, kFeasibility);
  }
  EXPECT_GT(stalled, 0);
}

TEST(IpoptTrajectoryOptimizer, NamesBadInput) {
  const TrajectoryProblem problem = TrapProblem(0, MetricKind::kPhong);
  TrajectoryOptions options;
  options.ipopt.ipopt_options["mu_stratgy"] = "adaptive";
  const std::string what = testing::ErrorOf(
      [&] { const IpoptTrajectoryOptimizer optimizer(problem, options); });
  EXPECT_NE(what.find("'mu_stratgy'"), std::string::npos);
  options = {};
  options.rows = 9;
  EXPECT_THROW(IpoptTrajectoryOptimizer(problem, options), InputError);
  options = {};
  options.max_rounds = 0;
  EXPECT_THROW(IpoptTrajectoryOptimizer(problem, options), InputError);
  const IpoptTrajectoryOptimizer optimizer(problem);
  Path path = StraightPath(problem);
  path[5].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(optimizer.Solve(path), InputError);
  path = StraightPath(problem);
  path.pop_back();
  EXPECT_THROW(optimizer.Solve(path), InputError);
  path = StraightPath(problem);
  path.back().x() += 1.0;
  EXPECT_THROW(optimizer.Solve(path), InputError);
}

}  // namespace
}  // namespace phongpd
