// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exact judge, distances by bisection, closed forms.
#include "planners/trajectory/corridor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "planners/exact/path_resampling.h"
#include "planners/exact/start_repair.h"
#include "planners/trajectory/corridor_program.h"
#include "problems/shapes/shapes.h"
#include "tests/support/path_problems.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::MakePathProblem;
using testing::PathProblem;

TrajectoryProblem WithoutMetrics(const PathProblem& source) {
  TrajectoryProblem problem;
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(source.contact)});
  problem.start = source.start;
  problem.goal = source.goal;
  problem.diagonal = ComputeBounds(source.contact).Diagonal();
  return problem;
}

Path Repaired(const PathProblem& source) {
  return StartRepair(TakeAsContactSpace(source.contact))
      .Repair(source.start, source.goal)
      .routes[0];
}

TEST(Corridor, ConvergesOnTheFamiliesExactlyFree) {
  for (const std::string family :
       {"Uaxis", "U", "L", "plate0.1", "plate0.005", "longplate", "hole",
        "torus", "cone_axes", "clutter", "channel0.01"}) {
    const PathProblem source = MakePathProblem(family, 1);
    const TrajectoryProblem problem = WithoutMetrics(source);
    const Path start = Repaired(source);
    const CorridorSummary summary = PolishInCorridor(problem, start);
    EXPECT_EQ(summary.status, PathStatus::kConverged) << family;
    EXPECT_TRUE(CheckPath(*problem.free_space, summary.path).free) << family;
    EXPECT_EQ(summary.path.size(), start.size());
    EXPECT_EQ(summary.objective, PathEnergy(problem, summary.path));
    // Clearance may have been missing and cost something, most at the mouth of
    // a channel.
    const double allowed = family == "channel0.01" ? 1.25 : 1.01;
    EXPECT_LT(summary.objective, allowed * PathEnergy(problem, start))
        << family;
    EXPECT_LE(summary.iterations, 250) << family;
  }
}

TEST(MissingClearance, IsWhatTheMarginExceedsTheDistanceBy) {
  // A plate's upper side is the plane z = 0.5, far from its rim.
  PathProblem source;
  source.contact = MakeBox({-5.0, -5.0, -0.5}, {5.0, 5.0, 0.5});
  TrajectoryProblem problem = WithoutMetrics(source);
  const double diagonal = std::sqrt(201.0);
  for (const double share : {0.05, 0.3, 0.9, 1.0, 1.7}) {
    const double z = 0.5 + share * 0.01 * diagonal;
    problem.start = {-1.0, 0.0, z};
    problem.goal = {1.0, 0.0, z};
    EXPECT_NEAR(MissingClearance(problem, StraightPath(problem)),
                std::max(0.0, 1.0 - share), 1e-9)
        << share;
  }
  problem.margin = 0.0;
  EXPECT_EQ(MissingClearance(problem, StraightPath(problem)), 0.0);
}

TEST(MissingClearance, ExpectsNoMoreThanMostOfHalfAGap) {
  // Two plates 0.2 apart with a margin that is larger than that.
  PathProblem source;
  source.contact = Joined(MakeBox({-5.0, -5.0, -0.5}, {5.0, 5.0, 0.5}),
                          MakeBox({-5.0, -5.0, 0.7}, {5.0, 5.0, 1.7}));
  TrajectoryProblem problem = WithoutMetrics(source);
  problem.diagonal = 10.0;
  problem.margin = 0.05;
  for (const double height : {0.01, 0.05, 0.094, 0.1}) {
    problem.start = {-1.0, 0.0, 0.5 + height};
    problem.goal = {1.0, 0.0, 0.5 + height};
    EXPECT_NEAR(MissingClearance(problem, StraightPath(problem)),
                std::max(0.0, 0.95 * 0.1 - height) / 0.5, 1e-9)
        << height;
  }
}

// By brute force over the contact space: each segment is above its planes by
// what they say, and every triangle near it is behind one of them.
TEST(PlanesAround, SeparateEverySegmentFromAllThatIsNear) {
  const PathProblem source = MakePathProblem("Uaxis", 2);
  const TrajectoryProblem problem = WithoutMetrics(source);
  const Path path = PolishInCorridor(problem, Repaired(source)).path;
  const std::vector<CorridorPlane> planes = PlanesAround(problem, path);
  ASSERT_GT(planes.size(), 10u);
  const double tolerance = 1e-9 * problem.diagonal;
  for (const CorridorPlane& plane : planes) {
    ASSERT_GE(plane.segment, 0);
    ASSERT_LT(plane.segment + 1, static_cast<int>(path.size()));
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    const auto above = [&](const Vector3d& q) {
      return plane.normal.dot(q - plane.point);
    };
    const double lowest =
        std::min(above(path[plane.segment]), above(path[plane.segment + 1]));
    EXPECT_NEAR(lowest, plane.distance, tolerance);
    // Below its lowest point or, of a level one, its middle.
    const Vector3d foot = plane.point + lowest * plane.normal;
    const Vector3d& a = path[plane.segment];
    const Vector3d& b = path[plane.segment + 1];
    EXPECT_NEAR((foot - a).norm() + (foot - b).norm(), (b - a).norm(),
                1e-7 * problem.diagonal);
  }
  for (int i = 0; i + 1 < static_cast<int>(path.size()); ++i) {
    for (const Triangle& t : source.contact.triangles) {
      // A point of the triangle that is near the segment's middle is enough to
      // ask for a plane.
      double nearest = 1e300;
      for (const int v : t) {
        nearest = std::min(nearest, (source.contact.vertices[v] -
                                     0.5 * (path[i] + path[i + 1]))
                                        .norm());
      }
      if (nearest > (2.0 * kFirstTrust) * problem.diagonal) continue;
      const bool is_behind = std::any_of(
          planes.begin(), planes.end(), [&](const CorridorPlane& plane) {
            return plane.segment == i &&
                   std::all_of(t.begin(), t.end(), [&](int v) {
                     return plane.normal.dot(source.contact.vertices[v] -
                                             plane.point) <= tolerance;
                   });
          });
      EXPECT_TRUE(is_behind) << "segment " << i;
    }
  }
  EXPECT_TRUE(PlanesAround(problem, StraightPath(problem)).empty());
}

TEST(Corridor, EnergyFallsAndEveryRoundIsFree) {
  // A corridor of one round more each time: its path is the next iterate.
  PathProblem source = MakePathProblem("Uaxis", 2);
  TrajectoryProblem problem = WithoutMetrics(source);
  problem.margin = 0.005;  // what the start has is more
  const Path start = Repaired(source);
  constexpr double kForever = std::numeric_limits<double>::infinity();
  double previous = PathEnergy(problem, start);
  for (int rounds = 1; rounds <= 6; ++rounds) {
    const CorridorSummary summary =
        PolishRounds(problem, start, rounds, kForever, {});
    ASSERT_TRUE(CheckPath(*problem.free_space, summary.path).free);
    EXPECT_LE(summary.objective, previous * (1.0 + 1e-12));
    EXPECT_GE(PathClearance(*problem.free_space, summary.path),
              (problem.margin - 1e-6) * problem.diagonal);
    previous = summary.objective;
    if (summary.status == PathStatus::kConverged) break;
    EXPECT_EQ(summary.status, PathStatus::kRoundLimit);
    EXPECT_EQ(summary.rounds.size(), static_cast<std::size_t>(rounds));
  }
}

TEST(Corridor, FindsTheShortestWayOverAnEdge) {
  // Over the top of a cube, in the plane y = 0: the straight line pulled over
  // the corner (0, 0, 1) of a thin wall; the optimum touches it at the margin.
  TrajectoryProblem problem;
  const TriangleMesh wall = MakeBox({-0.01, -2.0, -2.0}, {0.01, 2.0, 1.0});
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(wall)});
  problem.diagonal = 2.0;
  problem.start = {-1.0, 0.0, 0.5};
  problem.goal = {1.0, 0.0, 0.5};
  const Path start = ResampleKeepingCorners(
      {problem.start, {-0.5, 0.7, 1.6}, {0.3, 0.2, 1.4}, problem.goal}, 40);
  const CorridorSummary summary = PolishInCorridor(problem, start);
  EXPECT_EQ(summary.status, PathStatus::kConverged);
  // From below by the polyline over the edge without margin, from above by the
  // one over two points √2 margins away from the wall's edges.
  const double up = 2.0 * 0.02 * std::sqrt(0.5);
  const double least = 2.0 * std::hypot(0.99, 0.5) + 0.02;
  const double most = 2.0 * std::hypot(0.99 - up, 0.5 + up) + 0.02 + 2.0 * up;
  const double length = PathLength(summary.path);
  EXPECT_GE(length, least);
  EXPECT_LE(length, 1.002 * most);
  EXPECT_NEAR(summary.clearance, problem.margin, 1e-6);
}

TEST(Corridor, RestoresMissingClearance) {
  // A detour that grazes the cube's edge at a thousandth of the margin.
  TrajectoryProblem problem;
  const TriangleMesh cube =
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(cube)});
  problem.diagonal = ComputeBounds(cube).Diagonal();
  problem.start = {-2.0, 0.0, 0.5};
  problem.goal = {2.0, 0.0, 0.5};
  const double off = 1e-5 * problem.diagonal;
  const Path start = ResampleKeepingCorners({problem.start,
                                             {-1.0 - off, 0.0, 1.0 + off},
                                             {1.0 + off, 0.0, 1.0 + off},
                                             problem.goal},
                                            40);
  const CorridorSummary summary = PolishInCorridor(problem, start);
  EXPECT_EQ(summary.status, PathStatus::kConverged);
  const double margin = problem.margin * problem.diagonal;
  EXPECT_GE(PathClearance(*problem.free_space, summary.path), 0.999 * margin);
  EXPECT_GT(summary.rounds.front().missing, -1e-15);
  EXPECT_LT(summary.rounds.back().missing, 1e-6);
}

TEST(Corridor, CentresItselfInAPassageNarrowerThanTheMargin) {
  // Width 0.02, margin 0.03: 0.01 is what there is.
  TrajectoryProblem problem;
  const TriangleMesh block = MakePlateWithHole(2.0, 1.0, 0.02);
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(block)});
  problem.diagonal = 3.0;
  problem.start = {0.0, 0.0, 0.9};
  problem.goal = {0.0, 0.0, -0.9};
  const Path start = ResampleKeepingCorners(
      {problem.start, {0.009, 0.0, 0.4}, {-0.009, 0.008, -0.4}, problem.goal},
      40);
  ASSERT_TRUE(CheckPath(*problem.free_space, start).free);
  const CorridorSummary summary = PolishInCorridor(problem, start);
  EXPECT_TRUE(CheckPath(*problem.free_space, summary.path).free);
  EXPECT_GE(PathClearance(*problem.free_space, summary.path), 0.0098);
}

TEST(Corridor, StaysWithinTheBounds) {
  TrajectoryProblem problem;
  const TriangleMesh cube =
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  // No way over the top within the bounds but a gap of 0.1.
  const BoundingBox bounds = {Vector3d(-3.0, -1.1, -1.05),
                              Vector3d(3.0, 1.1, 1.1)};
  problem.free_space = std::make_shared<FreeSpace>(
      std::vector<ContactSpace>{TakeAsContactSpace(cube)}, bounds);
  problem.diagonal = ComputeBounds(cube).Diagonal();
  problem.start = {-2.0, 0.0, 0.0};
  problem.goal = {2.0, 0.0, 0.0};
  const Path start = ResampleKeepingCorners(
      {problem.start, {-1.2, 0.0, 1.09}, {1.2, 0.0, 1.09}, problem.goal}, 40);
  const CorridorSummary summary = PolishInCorridor(problem, start);
  EXPECT_TRUE(CheckPath(*problem.free_space, summary.path).free);
  EXPECT_LT(summary.objective, PathEnergy(problem, start));
}

TEST(Corridor, DoesNotDependOnUnitAndOffset) {
  const PathProblem source = MakePathProblem("cone_axes", 1);
  const Path start = Repaired(source);
  const double expected =
      PolishInCorridor(WithoutMetrics(source), start).objective;
  for (const double scale : {1e-3, 1e3}) {
    const Vector3d offset = scale * 1e3 * Vector3d(1.0, -0.5, 0.7);
    PathProblem moved = source;
    moved.contact = Translated(Scaled(source.contact, scale), offset);
    moved.start = scale * source.start + offset;
    moved.goal = scale * source.goal + offset;
    Path path;
    for (const Vector3d& q : start) path.push_back(scale * q + offset);
    const CorridorSummary summary =
        PolishInCorridor(WithoutMetrics(moved), path);
    EXPECT_EQ(summary.status, PathStatus::kConverged);
    EXPECT_NEAR(summary.objective, expected, 1e-3 * expected);
  }
}

TEST(CorridorProgram, DerivativesAreThoseOfItsValues) {
  PathProblem source = MakePathProblem("channel0.1", 2);
  TrajectoryProblem problem = WithoutMetrics(source);
  problem.waypoints = 12;
  problem.margin = 0.03;  // some segments lack clearance
  StartRepairOptions options;
  options.waypoints = problem.waypoints;
  const Path path = StartRepair(TakeAsContactSpace(source.contact))
                        .Repair(source.start, source.goal, options)
                        .routes[0];
  const PathSprings springs(problem, PathLength(path));
  const Eigen::VectorXd now = springs.ToVariables(path);
  const Corridor corridor = FindCorridor(problem, springs, path, 0.1);
  CorridorProgram program(problem, springs, corridor, now, 0.05, 20.0);
  const int n = program.variables(), m = program.rows();
  ASSERT_GT(n, 3 * problem.waypoints);
  ASSERT_GT(m, springs.rows());
  const Eigen::VectorXd x = program.Start();

  // The present path holds every row and bound.
  Eigen::VectorXd x_low(n), x_high(n), g_low(m), g_high(m), g(m);
  program.Bounds(x_low.data(), x_high.data(), g_low.data(), g_high.data());
  Eigen::VectorXd jacobian(program.jacobian_nonzeros());
  ASSERT_TRUE(program.Constraints(x.data(), g.data(), jacobian.data()));
  EXPECT_GE((x - x_low).minCoeff(), -1e-12);
  EXPECT_GE((x_high - x).minCoeff(), -1e-12);
  EXPECT_GE((g - g_low).head(m - springs.rows()).minCoeff(), -1e-9);

  // Everything is at most quadratic, so central differences are exact but for
  // rounding.
  const double h = 1e-4;
  Eigen::VectorXd gradient(n), multipliers(m), other(jacobian.size());
  for (int i = 0; i < m; ++i) multipliers[i] = 0.5 + 0.1 * (i % 7);
  program.ObjectiveGradient(x.data(), gradient.data());
  std::vector<int> row(static_cast<std::size_t>(jacobian.size())), col(row);
  program.JacobianPattern(row.data(), col.data());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(m, n);
  for (std::size_t i = 0; i < row.size(); ++i) {
    dense(row[i], col[i]) += jacobian[static_cast<Eigen::Index>(i)];
  }
  Eigen::VectorXd values(program.hessian_nonzeros());
  program.Hessian(x.data(), 2.0, multipliers.data(), values.data());
  std::vector<int> lower(static_cast<std::size_t>(values.size())), left(lower);
  program.HessianPattern(lower.data(), left.data());
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < lower.size(); ++i) {
    hessian(lower[i], left[i]) += values[static_cast<Eigen::Index>(i)];
    if (lower[i] != left[i]) {
      hessian(left[i], lower[i]) += values[static_cast<Eigen::Index>(i)];
    }
  }
  const auto lagrangian_gradient = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd sum(n), unused(m);
    program.ObjectiveGradient(at.data(), sum.data());
    sum *= 2.0;
    program.Constraints(at.data(), unused.data(), other.data());
    for (std::size_t i = 0; i < row.size(); ++i) {
      sum[col[i]] += multipliers[row[i]] * other[static_cast<Eigen::Index>(i)];
    }
    return sum;
  };
  for (int k = 0; k < n; ++k) {
    Eigen::VectorXd up = x, down = x, g_up(m), g_down(m);
    up[k] += h;
    down[k] -= h;
    EXPECT_NEAR(
        (program.Objective(up.data()) - program.Objective(down.data())) /
            (2.0 * h),
        gradient[k], 1e-8);
    const Eigen::VectorXd column =
        (lagrangian_gradient(up) - lagrangian_gradient(down)) / (2.0 * h);
    EXPECT_LE((column - hessian.col(k)).cwiseAbs().maxCoeff(), 1e-7);
    program.Constraints(up.data(), g_up.data(), other.data());
    program.Constraints(down.data(), g_down.data(), other.data());
    EXPECT_LE(
        ((g_up - g_down) / (2.0 * h) - dense.col(k)).cwiseAbs().maxCoeff(),
        1e-8);
  }
}

TEST(Corridor, IsDeterministic) {
  const PathProblem source = MakePathProblem("torus", 4);
  const Path start = Repaired(source);
  const TrajectoryProblem problem = WithoutMetrics(source);
  EXPECT_EQ(PolishInCorridor(problem, start).path,
            PolishInCorridor(problem, start).path);
}

TEST(Corridor, RefusesWhatItCannotUse) {
  const PathProblem source = MakePathProblem("plate0.1", 0);
  const TrajectoryProblem problem = WithoutMetrics(source);
  const Path line = StraightPath(problem);
  const CorridorSummary summary = PolishInCorridor(problem, line);
  EXPECT_EQ(summary.status, PathStatus::kNotFree);
  EXPECT_EQ(summary.path, line);
  EXPECT_TRUE(summary.rounds.empty());
  EXPECT_THROW(PolishInCorridor(problem, {problem.start, problem.goal}),
               InputError);
  EXPECT_THROW(PolishInCorridor(problem, line, 0.0), InputError);
}

}  // namespace
}  // namespace phongpd
