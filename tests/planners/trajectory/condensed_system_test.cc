// SPDX-License-Identifier: GPL-3.0-or-later
// Beside dense factorisations of the whole matrix.
#include "planners/trajectory/condensed_system.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace phongpd {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Inertia = CondensedSystem::Inertia;

// One triangle of a symmetric matrix, entries from 1 on.
struct Entries {
  std::vector<int> row, col;
  std::vector<double> value;

  void Add(int i, int j, double v) {
    row.push_back(i + 1);
    col.push_back(j + 1);
    value.push_back(v);
  }
  int count() const { return static_cast<int>(value.size()); }
  MatrixXd Dense(int size) const {
    MatrixXd m = MatrixXd::Zero(size, size);
    for (std::size_t k = 0; k < value.size(); ++k) {
      m(row[k] - 1, col[k] - 1) += value[k];
      if (row[k] != col[k]) m(col[k] - 1, row[k] - 1) += value[k];
    }
    return m;
  }
};

// A chain of variables, W of the given least eigenvalue up to rounding, rows
// that see three neighbours each, slacks of 10^[-spread, spread].
Entries RandomSystem(int variables, int rows, double shift, double spread,
                     double regularised, std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Entries m;
  for (int i = 0; i < variables; ++i) {
    // In two parts, as a Hessian and what a solver adds to it.
    m.Add(i, i, 2.0);
    m.Add(i, i, shift);
    if (i > 0) m.Add(i, i - 1, -1.0);
  }
  for (int k = 0; k < rows; ++k) {
    const int slack = variables + k, multiplier = variables + rows + k;
    m.Add(slack, slack, std::pow(10.0, spread * unit(*random)));
    m.Add(multiplier, slack, -1.0);
    m.Add(multiplier, multiplier, -regularised);
    for (int j = 0; j < 3; ++j) {
      m.Add(multiplier, (k + j) % variables, unit(*random));
    }
  }
  return m;
}

struct Size {
  int variables, rows;
};

TEST(CondensedSystem, SolvesWhatADenseFactorisationSolves) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (const Size size : {Size{1, 0}, Size{3, 1}, Size{30, 80}, Size{60, 10}}) {
    for (const double regularised : {0.0, 1e-3, 1e3}) {
      const int all = size.variables + 2 * size.rows;
      const Entries m = RandomSystem(size.variables, size.rows, 0.5, 2.0,
                                     regularised, &random);
      CondensedSystem system(size.rows);
      ASSERT_TRUE(system.Analyze(all, m.count(), m.row.data(), m.col.data()));
      ASSERT_EQ(system.Factorize(m.value.data()), Inertia::kAsWanted);
      VectorXd right(all);
      for (double& x : right) x = normal(random);
      const MatrixXd dense = m.Dense(all);
      const VectorXd expected = dense.fullPivLu().solve(right);
      VectorXd found = right;
      system.Solve(found.data());
      EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
    }
  }
}

// Near a solution slacks differ by twenty orders of magnitude; one step of
// refinement, of which solvers do several, leaves a residual of rounding.
TEST(CondensedSystem, IsRefinedToRoundingWhereSlacksSpreadWide) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  const int variables = 30, rows = 60, all = variables + 2 * rows;
  for (int run = 0; run < 20; ++run) {
    const Entries m = RandomSystem(variables, rows, 0.1, 10.0, 0.0, &random);
    CondensedSystem system(rows);
    ASSERT_TRUE(system.Analyze(all, m.count(), m.row.data(), m.col.data()));
    ASSERT_EQ(system.Factorize(m.value.data()), Inertia::kAsWanted);
    VectorXd right(all);
    for (double& x : right) x = normal(random);
    const MatrixXd dense = m.Dense(all);
    VectorXd found = right;
    system.Solve(found.data());
    for (int i = 0; i < 2; ++i) {
      VectorXd step = right - dense * found;
      system.Solve(step.data());
      found += step;
    }
    EXPECT_LT((dense * found - right).lpNorm<Eigen::Infinity>(),
              1e-9 * (right.norm() + found.norm()));
  }
}

TEST(CondensedSystem, KnowsTheInertia) {
  std::mt19937_64 random(3);
  const int variables = 12, rows = 5, all = variables + 2 * rows;
  int wanted = 0;
  for (int run = 0; run < 200; ++run) {
    const double shift = -3.0 + 0.02 * run;
    const Entries m = RandomSystem(variables, rows, shift, 1.0, 0.0, &random);
    CondensedSystem system(rows);
    ASSERT_TRUE(system.Analyze(all, m.count(), m.row.data(), m.col.data()));
    const VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(m.Dense(all)).eigenvalues();
    const bool is_wanted = (eigenvalues.array() < 0.0).count() == rows;
    wanted += is_wanted ? 1 : 0;
    EXPECT_EQ(system.Factorize(m.value.data()) == Inertia::kAsWanted,
              is_wanted);
  }
  EXPECT_GT(wanted, 20);
  EXPECT_LT(wanted, 180);
}

TEST(CondensedSystem, IsFactorisedAgainWithOtherValues) {
  std::mt19937_64 random(4);
  const Entries first = RandomSystem(9, 4, 1.0, 1.0, 0.0, &random);
  Entries second = first;
  for (double& v : second.value) v *= 3.0;
  CondensedSystem system(4);
  ASSERT_TRUE(
      system.Analyze(17, first.count(), first.row.data(), first.col.data()));
  VectorXd one = VectorXd::Ones(17), other = VectorXd::Ones(17);
  ASSERT_EQ(system.Factorize(first.value.data()), Inertia::kAsWanted);
  system.Solve(one.data());
  ASSERT_EQ(system.Factorize(second.value.data()), Inertia::kAsWanted);
  system.Solve(other.data());
  EXPECT_LT((one - 3.0 * other).norm(), 1e-12 * one.norm());
}

TEST(CondensedSystem, RefusesOtherFormsAndValues) {
  std::mt19937_64 random(5);
  const Entries good = RandomSystem(3, 2, 1.0, 1.0, 0.0, &random);
  // Two slacks, two multipliers, a slack and a variable, a slack and another
  // row's multiplier: none may know each other.
  const int pairs[][2] = {{4, 3}, {6, 5}, {3, 0}, {6, 3}, {7, 0}};
  for (const auto& [i, j] : pairs) {
    Entries bad = good;
    bad.Add(i, j, 1.0);
    CondensedSystem system(2);
    EXPECT_FALSE(system.Analyze(7, bad.count(), bad.row.data(), bad.col.data()))
        << i << ' ' << j;
  }
  CondensedSystem none(4);
  EXPECT_FALSE(none.Analyze(7, good.count(), good.row.data(), good.col.data()));
  CondensedSystem system(2);
  ASSERT_TRUE(
      system.Analyze(7, good.count(), good.row.data(), good.col.data()));
  for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    for (int k = 0; k < good.count(); ++k) {
      Entries bad = good;
      bad.value[static_cast<std::size_t>(k)] = value;
      EXPECT_EQ(system.Factorize(bad.value.data()), Inertia::kOther) << k;
    }
  }
}

}  // namespace
}  // namespace phongpd
