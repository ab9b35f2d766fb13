// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a path in a world.  Truth: distances of boxes in closed form,
// difference quotients, the exact judge, and the constraint they are made of.
#include "planners/world/non_penetration_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// A cube of side 0.2 and a box; C_obj is [−0.6, 0.6]³.
World BoxWorld() {
  Workspace workspace;
  workspace.robot = MakeSolid(
      MakeBox(Vector3d::Constant(-0.1), Vector3d::Constant(0.1)), "robot");
  workspace.obstacles = {MakeSolid(
      MakeBox(Vector3d::Constant(-0.5), Vector3d::Constant(0.5)), "box")};
  return World(workspace);
}

const Vector3d kStart(-2, 0, 0), kGoal(2, 0, 0);

// d of the box, inside as well.
double BoxDistance(const Vector3d& q) {
  const Vector3d beyond = q.cwiseAbs().array() - 0.6;
  return beyond.maxCoeff() <= 0.0 ? beyond.maxCoeff()
                                  : beyond.cwiseMax(0.0).norm();
}

RowsOptions Euclid(int waypoints, int samples) {
  RowsOptions options;
  options.waypoints = waypoints;
  options.samples_per_segment = samples;
  options.penetration.metric = MetricKind::kEuclidean;
  return options;
}

TEST(NonPenetrationRows, AreTheDistancesOfTheSamples) {
  const World world = BoxWorld();
  NonPenetrationRows rows(world, kStart, kGoal, Euclid(2, 1));
  ASSERT_EQ(rows.variables(), 6);
  ASSERT_EQ(rows.rows(), 5);  // three middles, two waypoints
  VectorXd u(6), g(5);
  u << -1, 0.3, 0.1, 0.2, 1.0, -0.3;
  rows.Values(u, g);
  const std::vector<Vector3d> path = rows.Path(u);
  ASSERT_EQ(path.size(), 4U);
  int row = 0;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i > 0) {
      EXPECT_NEAR(g[row++], BoxDistance(path[k]), 1e-12) << i;
    }
    EXPECT_NEAR(g[row++], BoxDistance(0.5 * (path[k] + path[k + 1])), 1e-12);
  }
  VectorXd sized;
  rows.Values(u, &sized);
  EXPECT_EQ(sized, g);
  EXPECT_EQ(rows.lower(), VectorXd::Constant(5, rows.margin()));
  EXPECT_TRUE((rows.upper().array() == INFINITY).all());
  EXPECT_DOUBLE_EQ(rows.margin(), 0.01 * world.diagonal());
}

TEST(NonPenetrationRows, HaveTheDerivativesOfDifferenceQuotients) {
  const World world = BoxWorld();
  NonPenetrationRows rows(world, kStart, kGoal, Euclid(3, 0));
  EXPECT_GT(rows.samples_per_segment(), 1);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> side(0.7, 1.4);
  VectorXd u(9), g(rows.rows()), above(rows.rows()), below(rows.rows());
  Eigen::SparseMatrix<double> jacobian;
  for (int trial = 0; trial < 5; ++trial) {
    for (double& x : u) x = side(random);
    rows.Start(u);
    rows.Jacobian(u, &jacobian);
    ASSERT_EQ(jacobian.rows(), rows.rows());
    VectorXd entries(rows.nonzeros());
    rows.Evaluate(u, g, entries);
    for (int k = 0; k < u.size(); ++k) {
      const double step = 1e-6;
      VectorXd moved = u;
      moved[k] = u[k] + step;
      rows.Values(moved, above);
      moved[k] = u[k] - step;
      rows.Values(moved, below);
      const VectorXd quotient = (above - below) / (2.0 * step);
      EXPECT_LT((quotient - VectorXd(jacobian.col(k))).cwiseAbs().maxCoeff(),
                1e-4)
          << trial << ", " << k;
    }
  }
}

// What the rule promises: where all rows hold, the whole path is free.
TEST(NonPenetrationRows, ByTheRuleWhatHoldsIsFree) {
  const World world = BoxWorld();
  RowsOptions options = Euclid(12, 0);
  options.max_segment = 0.6;
  NonPenetrationRows rows(world, kStart, kGoal, options);
  const FreeSpace& space = *world.Spaces(SpaceLayout::kMerged).free_space;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> height(0.0, 1.2);
  VectorXd g(rows.rows());
  int held = 0, broken = 0;
  for (int trial = 0; trial < 400; ++trial) {
    VectorXd u = rows.StraightLine();
    const double up = height(random);
    for (int i = 0; i < 12; ++i) {
      u[3 * i + 1] = up * std::min(1.0, 0.5 * std::min(i + 1, 12 - i));
    }
    rows.Start(u);
    rows.Values(u, g);
    const bool holds = (g - rows.lower()).minCoeff() >= 0.0;
    const bool is_free = CheckPath(space, rows.Path(u)).free;
    held += holds;
    broken += !is_free;
    EXPECT_TRUE(is_free || !holds) << trial;
  }
  EXPECT_GT(held, 20);
  EXPECT_GT(broken, 100);
}

TEST(NonPenetrationRows, RefuseWhatDoesNotFit) {
  const World world = BoxWorld();
  const auto make = [&](const RowsOptions& options, const Vector3d& start) {
    NonPenetrationRows(world, start, kGoal, options);
  };
  EXPECT_NO_THROW(make(Euclid(3, 2), kStart));
  EXPECT_THROW(make(Euclid(0, 2), kStart), InputError);
  EXPECT_THROW(make(Euclid(3, -1), kStart), InputError);
  EXPECT_THROW(make(Euclid(3, 2), {NAN, 0, 0}), InputError);
  // By the rule both ends keep the margin.
  EXPECT_THROW(make(Euclid(3, 0), {-0.605, 0, 0}), InputError);
  EXPECT_NO_THROW(make(Euclid(3, 2), {-0.605, 0, 0}));
  RowsOptions options = Euclid(3, 2);
  options.margin = Length::FromUnit(100.0);
  EXPECT_THROW(make(options, kStart), InputError);
  options = Euclid(3, 2);
  options.max_segment = NAN;
  EXPECT_THROW(make(options, kStart), InputError);

  NonPenetrationRows rows(world, kStart, kGoal, Euclid(3, 2));
  VectorXd u = rows.StraightLine(), g(rows.rows());
  EXPECT_THROW(rows.Values(VectorXd::Zero(8), g), InputError);
  VectorXd short_g(rows.rows() - 1);
  EXPECT_THROW(rows.Values(u, short_g), InputError);
  u[4] = INFINITY;
  EXPECT_THROW(rows.Values(u, g), InputError);
  EXPECT_THROW(rows.Accept(VectorXd::Zero(3)), InputError);
}

}  // namespace
}  // namespace phongpd
