// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the norm itself, differences of slacks, and dense rows.
#include "planners/trajectory/curve_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace phongpd::internal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Row = CurveProgram::Row;

Row RandomRow(Row::Kind kind, std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Row row;
  row.kind = kind;
  row.first = 1;
  row.last = 4;
  for (int j = 1; j <= 4; ++j) row.weight[j] = uniform(*random);
  for (int axis = 0; axis < 3; ++axis) {
    row.value[axis] = 0.3 * uniform(*random);
    row.direction[axis] = uniform(*random);
  }
  row.direction.normalize();
  row.eta = uniform(*random);
  row.t = -2.0;
  row.constant = -1.0;
  return row;
}

// Of kNorm: what |y| is, and what it may be.
std::pair<double, double> NormAndRoom(const Row& row, const CurveLocal& x) {
  Vector3d y = row.value;
  for (int j = 0; j < 6; ++j) y += row.weight[j] * x.segment<3>(3 * j);
  return {y.norm(),
          -row.constant - row.eta * x[kCurveEta] - row.t * x[kCurveT]};
}

double Slack(const Row& row, const CurveLocal& x) {
  CurveRowNow now(row);
  double slack = 0.0;
  WriteSlacks(&now, x, &slack);
  return slack;
}

// Positive within the norm, and zero on it.
TEST(CurveRow, IsWithinANormWhereItsSlackSaysSo) {
  std::mt19937_64 random(1);
  int within = 0;
  for (int i = 0; i < 200; ++i) {
    const Row row = RandomRow(Row::kNorm, &random);
    const CurveLocal x = CurveLocal::Random();
    const auto [norm, room] = NormAndRoom(row, x);
    EXPECT_EQ(Slack(row, x) > 0.0, norm < room) << norm << " " << room;
    within += norm < room;
    if (!(room > 0.0)) continue;
    // As far as the norm is from what it may be, times 1 to 2 within.
    EXPECT_NEAR(Slack(row, x), (room - norm) * (1.0 + norm / room), 1e-12);
  }
  EXPECT_GT(within, 20);
  EXPECT_LT(within, 180);
}

TEST(CurveRow, KnowsWhatAStepChangesTheSlackByToSecondOrder) {
  std::mt19937_64 random(2);
  for (const Row::Kind kind : {Row::kNorm, Row::kDirection, Row::kScalar}) {
    for (int i = 0; i < 20; ++i) {
      const Row row = RandomRow(kind, &random);
      const CurveLocal x = 0.05 * CurveLocal::Random();
      const CurveLocal u = CurveLocal::Random();
      CurveRowNow now(row);
      double slack = 0.0, slope = 0.0;
      WriteSlacks(&now, x, &slack);
      const double bend = kind == Row::kNorm ? BendOf(now, u) : 0.0;
      WriteSlopes(now, u, &slope);
      const double h = 1e-3;
      const double error =
          Slack(row, x + h * u) - (slack - h * slope - h * h * bend);
      EXPECT_LT(std::abs(error), 100.0 * h * h * h) << kind;
      // Its gradient is the same, and so is its curvature.
      CurveLocal gradient = CurveLocal::Zero();
      AddRow(now, {1.0, 1.0}, &gradient);
      EXPECT_NEAR(gradient.dot(u), slope, 1e-12);
      CurveLocalMatrix lower = CurveLocalMatrix::Zero();
      AddSquare(now, {3.0, 3.0}, 5.0, &lower);
      const CurveLocalMatrix whole = lower.selfadjointView<Eigen::Lower>();
      EXPECT_NEAR(u.dot(whole * u), 3.0 * slope * slope + 10.0 * bend, 1e-10);
    }
  }
}

// A row and what repeats it, with a wish of its own for m.
TEST(CurveRow, AddsTwoThatRepeatEachOtherAsOne) {
  std::mt19937_64 random(3);
  Row first = RandomRow(Row::kDirection, &random);
  first.t = 0.0;
  Row second = first;
  second.constant = -2.0;
  second.missing = -1.0;
  second.repeats = true;
  const Row third = RandomRow(Row::kScalar, &random);
  const std::vector<Row> of = {first, second, third};
  std::vector<CurveRowNow> rows;
  AppendRows(of, &rows);
  ASSERT_EQ(rows.size(), 2u);
  const Eigen::Array3d weights(0.5, 2.0, 3.0);

  // Slacks, and what they fall by: of all three, one after another.
  const auto slacks_at = [&](const CurveLocal& x) {
    Eigen::Vector3d slacks;
    double* to = slacks.data();
    for (CurveRowNow& row : rows) to = WriteSlacks(&row, x, to);
    EXPECT_EQ(to, slacks.data() + 3);
    return slacks;
  };
  const CurveLocal x = CurveLocal::Random();
  const Eigen::Vector3d slacks = slacks_at(x);
  EXPECT_NEAR(slacks[0], Slack(first, x), 1e-14);
  EXPECT_NEAR(slacks[1], slacks[0] + 1.0 + x[kCurveMissing], 1e-14);
  EXPECT_NEAR(slacks[2], Slack(third, x), 1e-14);
  MatrixXd dense(3, 21);
  for (int k = 0; k < 21; ++k) {
    double* to = dense.col(k).data();
    for (const CurveRowNow& row : rows) {
      to = WriteSlopes(row, CurveLocal::Unit(k), to);
    }
    EXPECT_LT(
        (slacks_at(x + CurveLocal::Unit(k)) - slacks + dense.col(k)).norm(),
        1e-14);
  }
  CurveLocalMatrix lower = CurveLocalMatrix::Zero();
  CurveLocal gradient = CurveLocal::Zero();
  std::vector<int> places;
  ForRows(rows, 0, 2, weights.data(),
          [&](const CurveRowNow& row, const CurveRowWeights& by, int at) {
            AddSquare(row, by, 0.0, &lower);
            AddRow(row, by, &gradient);
            places.push_back(at);
          });
  EXPECT_EQ(places, (std::vector<int>{0, 2}));
  const VectorXd w = weights.matrix();
  EXPECT_LT((MatrixXd(lower.selfadjointView<Eigen::Lower>()) -
             dense.transpose() * w.asDiagonal() * dense)
                .norm(),
            1e-12);
  EXPECT_LT((gradient - dense.transpose() * w).norm(), 1e-12);
}

}  // namespace
}  // namespace phongpd::internal
