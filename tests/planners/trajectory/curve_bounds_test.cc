// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: each bound as a dense row, its differences taken one after another.
#include "planners/trajectory/curve_bounds.h"

#include <gtest/gtest.h>

#include <random>

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-12;

CurveProgram::Bounds RandomBounds(int order, int first, int last,
                                  std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  CurveProgram::Bounds bounds;
  bounds.order = order;
  bounds.first = first;
  bounds.last = last;
  bounds.most = uniform(*random);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == 1 && order == 2) continue;  // not bounded
    bounds.scale[axis] = uniform(*random);
    bounds.t[axis] = -order;
    for (int j = 0; j <= 5 - order; ++j) {
      bounds.value(axis, j) = uniform(*random) - 1.0;
    }
  }
  return bounds;
}

// Rows · u ≤ room.
struct Rows {
  MatrixXd rows;
  VectorXd room;
};

Rows DenseRows(const CurveProgram::Bounds& bounds) {
  const int columns = bounds.last - bounds.first + 1;
  Rows dense{MatrixXd::Zero(6 * columns, 21), VectorXd(6 * columns)};
  MatrixXd differences = MatrixXd::Identity(6, 6);
  for (int k = 0; k < bounds.order; ++k) {
    const Eigen::Index n = differences.rows() - 1;
    const MatrixXd next = differences.bottomRows(n) - differences.topRows(n);
    differences = next;
  }
  int at = 0;
  for (const double sign : {1.0, -1.0}) {
    for (int j = bounds.first; j <= bounds.last; ++j) {
      for (int axis = 0; axis < 3; ++axis, ++at) {
        const double value = bounds.value(axis, j);
        for (int k = 0; k < 6; ++k) {
          dense.rows(at, 3 * k + axis) =
              sign * bounds.scale[axis] * differences(j, k);
        }
        // Slower pieces have more room, as all have at a slower pace.
        dense.rows(at, kCurveEta) = dense.rows(at, kCurveT) = bounds.t[axis];
        dense.room[at] = bounds.most - sign * value;
      }
    }
  }
  return dense;
}

TEST(CurveBounds, AreTheirRowsWrittenOut) {
  std::mt19937_64 random(1);
  for (int order = 0; order <= 3; ++order) {
    for (const int cut : {0, 1, 2}) {
      const auto bounds =
          RandomBounds(order, cut > 0, 5 - order - cut / 2, &random);
      const Rows truth = DenseRows(bounds);
      const int n = RowsOf(bounds);
      ASSERT_EQ(n, truth.rows.rows());
      const CurveLocal u = CurveLocal::Random();

      VectorXd slopes(n), slacks(n);
      SlopesOf(bounds, u, slopes.data());
      SlacksOf(bounds, u, slacks.data());
      EXPECT_LT((slopes - truth.rows * u).norm(), kRounding) << order;
      EXPECT_LT((slacks - truth.room + truth.rows * u).norm(), kRounding);

      const VectorXd weights = VectorXd::Random(n).cwiseAbs();
      CurveLocal gradient = CurveLocal::Ones();
      AddGradients(bounds, weights.data(), &gradient);
      EXPECT_LT(
          (gradient - CurveLocal::Ones() - truth.rows.transpose() * weights)
              .norm(),
          kRounding)
          << order;
      EXPECT_NEAR(TermsInT(bounds, weights.data()),
                  weights.dot(truth.rows.col(kCurveT)), kRounding);

      CurveLocalMatrix lower = CurveLocalMatrix::Zero();
      AddSquares(bounds, weights.data(), &lower);
      const MatrixXd squares =
          truth.rows.transpose() * weights.asDiagonal() * truth.rows;
      EXPECT_LT(
          (MatrixXd(lower.selfadjointView<Eigen::Lower>()) - squares).norm(),
          kRounding)
          << order;
      EXPECT_TRUE(
          lower.triangularView<Eigen::StrictlyUpper>().toDenseMatrix().isZero(
              0.0));
    }
  }
}

}  // namespace
}  // namespace phongpd::internal
