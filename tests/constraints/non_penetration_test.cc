// SPDX-License-Identifier: GPL-3.0-or-later
#include "constraints/non_penetration.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Metrics = std::vector<std::shared_ptr<const SignedMetric>>;

constexpr int kWaypoints = 6;
const Vector3d kStart(-2.0, 0.1, 0.05);
const Vector3d kGoal(2.0, -0.1, 0.1);

std::shared_ptr<const SignedMetric> Metric(const TriangleMesh& mesh,
                                           JacobianKind jacobian) {
  SignedMetricOptions options;
  options.jacobian = jacobian;
  return std::make_shared<SignedMetric>(TakeAsContactSpace(mesh), options);
}

TriangleMesh Ball(const Vector3d& center) {
  return Translated(MakeIcoBall(0.8, 2), center);
}

// The straight line, every waypoint moved by up to `noise`.
VectorXd Line(double noise, unsigned seed, const PathFrame& frame = {}) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  VectorXd u(3 * kWaypoints);
  for (int i = 0; i < kWaypoints; ++i) {
    Vector3d p = kStart + (i + 1.0) / (kWaypoints + 1.0) * (kGoal - kStart);
    for (int axis = 0; axis < 3; ++axis) p[axis] += uniform(random);
    u.segment<3>(3 * i) = (p - frame.center) / frame.unit;
  }
  return u;
}

struct Rows {
  VectorXd values, jacobian;
};

Rows Evaluate(const NonPenetrationConstraint& rows, const VectorXd& u,
              const BranchSet& branches, NonPenetrationCounts* counts) {
  Rows result{VectorXd(rows.rows()), VectorXd(rows.nonzeros())};
  EXPECT_TRUE(rows.Evaluate(u.data(), branches, result.values.data(),
                            result.jacobian.data(), counts));
  return result;
}

TEST(NonPenetration, CountsRowsAndPatternBySampleWaypointAndSpace) {
  const Metrics one{Metric(Ball({0, 0, 0}), JacobianKind::kExact)};
  const std::vector<int> none(kWaypoints + 1, 0), two(kWaypoints + 1, 2);
  const NonPenetrationConstraint waypoints(one, kStart, kGoal, kWaypoints,
                                           none);
  EXPECT_EQ(waypoints.rows(), kWaypoints);
  EXPECT_EQ(waypoints.nonzeros(), 3 * kWaypoints);
  const NonPenetrationConstraint dense(one, kStart, kGoal, kWaypoints, two);
  EXPECT_EQ(dense.rows(), kWaypoints + 2 * (kWaypoints + 1));
  // First and last segment touch one free waypoint, the others two.
  EXPECT_EQ(dense.nonzeros(),
            3 * kWaypoints + 2 * (2 * 3 + (kWaypoints - 1) * 6));
  const Metrics three(3, Metric(Ball({0, 0, 0}), JacobianKind::kExact));
  const NonPenetrationConstraint all(three, kStart, kGoal, kWaypoints, two, 2);
  EXPECT_EQ(all.rows(), 6 * dense.rows());
  std::vector<int> row(static_cast<std::size_t>(dense.nonzeros())), col(row);
  dense.Sparsity(row.data(), col.data());
  std::set<std::pair<int, int>> entries;
  for (std::size_t i = 0; i < row.size(); ++i) {
    EXPECT_LT(row[i], dense.rows());
    EXPECT_LT(col[i], dense.variables());
    EXPECT_TRUE(entries.emplace(row[i], col[i]).second);
  }
}

TEST(NonPenetration, ValuesAreTheMetricAtTheSamples) {
  PathFrame frame;
  frame.center = Vector3d(0.3, 0.2, 0.1);
  frame.unit = 2.5;
  const auto metric = Metric(Ball({0, 0, 0}), JacobianKind::kDirection);
  const NonPenetrationConstraint rows({metric}, kStart, kGoal, kWaypoints,
                                      std::vector<int>(kWaypoints + 1, 2), 1,
                                      frame);
  const VectorXd u = Line(0.05, 1, frame);
  const Rows found = Evaluate(rows, u, rows.Start(u.data(), nullptr), nullptr);
  int sample = 0;
  for (int j = 1; j <= 3 * kWaypoints + 2; ++j, ++sample) {
    const int segment = j / 3;
    const auto point = [&](int i) -> Vector3d {
      if (i == 0) return kStart;
      if (i == kWaypoints + 1) return kGoal;
      return frame.center + frame.unit * u.segment<3>(3 * (i - 1));
    };
    const double t = (j % 3) / 3.0;
    const Vector3d q = (1.0 - t) * point(segment) + t * point(segment + 1);
    EXPECT_LT((rows.SamplePoint(sample, u.data()) - q).norm(), 1e-14);
    EXPECT_NEAR(found.values[sample], metric->Query(q).value / frame.unit,
                1e-12);
  }
  EXPECT_EQ(sample, rows.samples());
}

TEST(NonPenetration, ExactJacobianIsTheDerivativeForSeveralSpaces) {
  PathFrame frame;
  frame.unit = 3.0;
  const Metrics metrics{
      Metric(Ball({-0.7, 0.2, 0.0}), JacobianKind::kExact),
      Metric(Rotated(MakeBox({0.2, -0.5, -0.4}, {1.2, 0.5, 0.6}),
                     GenericRotation()),
             JacobianKind::kExact)};
  const NonPenetrationConstraint rows(metrics, kStart, kGoal, kWaypoints,
                                      {0, 1, 2, 3, 2, 1, 0}, 2, frame);
  std::vector<int> row(static_cast<std::size_t>(rows.nonzeros())), col(row);
  rows.Sparsity(row.data(), col.data());
  int off = 0, compared = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const VectorXd u = Line(0.2, seed, frame);
    const BranchSet branches = rows.Start(u.data(), nullptr);
    const Rows at = Evaluate(rows, u, branches, nullptr);
    Eigen::MatrixXd dense =
        Eigen::MatrixXd::Zero(rows.rows(), rows.variables());
    for (std::size_t i = 0; i < row.size(); ++i) {
      dense(row[i], col[i]) = at.jacobian[static_cast<int>(i)];
    }
    const double h = 1e-7;
    for (int j = 0; j < rows.variables(); ++j) {
      VectorXd ahead = u, behind = u;
      ahead[j] += h;
      behind[j] -= h;
      const VectorXd difference =
          (Evaluate(rows, ahead, branches, nullptr).values -
           Evaluate(rows, behind, branches, nullptr).values) /
          (2.0 * h);
      for (int i = 0; i < rows.rows(); ++i) {
        ++compared;
        off += std::abs(difference[i] - dense(i, j)) > 1e-5 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(compared, 5000);
  EXPECT_LE(off, compared / 1000);
}

// Points a solver tries and rejects leave no trace.
TEST(NonPenetration, OnlyCommitAdvancesBranches) {
  const Metrics metrics{Metric(Rotated(MakeU(2.0, 0.4, 1.0), GenericRotation()),
                               JacobianKind::kDirection)};
  const NonPenetrationConstraint rows(metrics, kStart, kGoal, kWaypoints,
                                      std::vector<int>(kWaypoints + 1, 3));
  const VectorXd u = Line(0.1, 2);
  NonPenetrationCounts counts;
  BranchSet branches = rows.Start(u.data(), &counts);
  EXPECT_EQ(counts.cold, rows.samples());
  const Rows first = Evaluate(rows, u, branches, &counts);
  for (unsigned seed = 10; seed < 20; ++seed) {
    Evaluate(rows, Line(0.6, seed), branches, &counts);
  }
  EXPECT_GT(counts.warm, 20);
  const Rows again = Evaluate(rows, u, branches, &counts);
  EXPECT_EQ(first.values, again.values);
  EXPECT_EQ(first.jacobian, again.jacobian);
  // Committed branches belong to the committed point.
  const VectorXd next = Line(0.15, 3);
  const Rows trial = Evaluate(rows, next, branches, nullptr);
  rows.Commit(next.data(), &branches, &counts);
  const Rows accepted = Evaluate(rows, next, branches, nullptr);
  EXPECT_LT((trial.values - accepted.values).cwiseAbs().maxCoeff(), 1e-9);
}

// Whoever evaluated a point need not ask again once it is accepted.
TEST(NonPenetration, EvaluationTellsTheBranchesThatCommitWouldBring) {
  const Metrics metrics{Metric(Rotated(MakeU(2.0, 0.4, 1.0), GenericRotation()),
                               JacobianKind::kDirection),
                        Metric(Ball({0.5, 0, 0}), JacobianKind::kDirection)};
  for (const int count : {1, 3}) {
    const NonPenetrationConstraint rows(metrics, kStart, kGoal, kWaypoints,
                                        std::vector<int>(kWaypoints + 1, 3),
                                        count);
    BranchSet committed = rows.Start(Line(0.1, 2).data(), nullptr);
    long warm = 0;
    for (unsigned seed = 3; seed < 13; ++seed) {
      const VectorXd u = Line(0.6, seed);
      BranchSet next = committed;
      ASSERT_TRUE(
          rows.Evaluate(u.data(), committed, nullptr, nullptr, nullptr, &next));
      NonPenetrationCounts counts;
      rows.Commit(u.data(), &committed, &counts);
      ASSERT_EQ(next.branches.size(), committed.branches.size());
      for (std::size_t i = 0; i < next.branches.size(); ++i) {
        EXPECT_EQ(next.branches[i].triangle, committed.branches[i].triangle);
        EXPECT_EQ(next.branches[i].lambda, committed.branches[i].lambda);
        EXPECT_EQ(next.branches[i].s, committed.branches[i].s);
      }
      EXPECT_EQ(next.changes, counts.branch_changes);
      warm += counts.warm;
    }
    EXPECT_GT(warm, 20);
    BranchSet small;
    EXPECT_THROW(rows.Evaluate(Line(0.1, 2).data(), committed, nullptr, nullptr,
                               nullptr, &small),
                 InputError);
  }
}

TEST(NonPenetration, RefusesPointsThatAreNotFinite) {
  const Metrics metrics{Metric(Ball({0, 0, 0}), JacobianKind::kDirection)};
  const NonPenetrationConstraint rows(metrics, kStart, kGoal, kWaypoints,
                                      std::vector<int>(kWaypoints + 1, 1), 3);
  VectorXd u = Line(0.0, 0);
  BranchSet branches = rows.Start(u.data(), nullptr);
  VectorXd values(rows.rows()), jacobian(rows.nonzeros());
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    u[4] = bad;
    EXPECT_FALSE(rows.Evaluate(u.data(), branches, values.data(),
                               jacobian.data(), nullptr));
    rows.Commit(u.data(), &branches, nullptr);
  }
  for (const double large : {1e12, 1e200, 1e306, -1e306}) {
    u[4] = large;
    EXPECT_TRUE(rows.Evaluate(u.data(), branches, values.data(),
                              jacobian.data(), nullptr));
    EXPECT_TRUE(values.allFinite() && jacobian.allFinite()) << large;
  }
}

TEST(NonPenetration, NamesBadInput) {
  const Metrics metrics{Metric(Ball({0, 0, 0}), JacobianKind::kDirection)};
  const std::vector<int> samples(kWaypoints + 1, 1);
  const auto make = [&](const Metrics& m, const Vector3d& start, int n,
                        const std::vector<int>& s) {
    return NonPenetrationConstraint(m, start, kGoal, n, s);
  };
  EXPECT_THROW(make({}, kStart, kWaypoints, samples), InputError);
  EXPECT_THROW(make({nullptr}, kStart, kWaypoints, samples), InputError);
  EXPECT_THROW(make(metrics, kStart, 0, {1}), InputError);
  EXPECT_THROW(make(metrics, kStart, kWaypoints, {1, 2}), InputError);
  EXPECT_THROW(
      NonPenetrationConstraint(metrics, kStart, kGoal, kWaypoints, samples, 9),
      InputError);
  EXPECT_THROW(make(metrics, Vector3d(NAN, 0, 0), kWaypoints, samples),
               InputError);
}

TEST(NonPenetration, GivesValuesOrJacobianAlone) {
  const Metrics metrics{Metric(Ball({0, 0, 0}), JacobianKind::kExact)};
  const NonPenetrationConstraint rows(metrics, kStart, kGoal, kWaypoints,
                                      std::vector<int>(kWaypoints + 1, 1));
  const VectorXd u = Line(0.05, 4);
  const BranchSet branches = rows.Start(u.data(), nullptr);
  const Rows both = Evaluate(rows, u, branches, nullptr);
  VectorXd values(rows.rows()), jacobian(rows.nonzeros());
  EXPECT_TRUE(
      rows.Evaluate(u.data(), branches, values.data(), nullptr, nullptr));
  EXPECT_TRUE(
      rows.Evaluate(u.data(), branches, nullptr, jacobian.data(), nullptr));
  EXPECT_EQ(values, both.values);
  EXPECT_EQ(jacobian, both.jacobian);
}

TEST(NonPenetration, ValuesBeyondAllDoublesAreTheLargest) {
  const Metrics metrics{Metric(Ball({0, 0, 0}), JacobianKind::kExact)};
  const NonPenetrationConstraint rows(metrics, kStart, kGoal, 1, {0, 0}, 1,
                                      {Vector3d(1e20, 0, 0), 1e-300});
  const VectorXd u = VectorXd::Zero(3);
  const Rows at = Evaluate(rows, u, rows.Start(u.data(), nullptr), nullptr);
  EXPECT_EQ(at.values[0], std::numeric_limits<double>::max());
  EXPECT_LT((at.jacobian - Vector3d::UnitX()).norm(), 1e-15);
}

}  // namespace
}  // namespace phongpd
