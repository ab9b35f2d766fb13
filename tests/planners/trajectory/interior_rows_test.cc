// SPDX-License-Identifier: GPL-3.0-or-later
// By another route: row by row, as the equations of a step have it.
#include "planners/trajectory/interior_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace phongpd::internal {
namespace {

using Eigen::ArrayXd;

constexpr int kRows = 37;
constexpr double kMu = 0.3;

ArrayXd Uniform(double least, double most, std::mt19937_64* random) {
  std::uniform_real_distribution<double> uniform(least, most);
  return ArrayXd::NullaryExpr(kRows, [&] { return uniform(*random); });
}

TEST(InteriorRows, BeginWithTheProductsAskedFor) {
  std::mt19937_64 random(1);
  const ArrayXd products = Uniform(0.1, 0.5, &random);
  InteriorRows rows;
  rows.Begin(Uniform(0.1, 2.0, &random), products);
  double sum = 0.0;
  for (int i = 0; i < kRows; ++i) {
    EXPECT_NEAR(rows.slack[i] * rows.dual[i], products[i], 1e-15);
    sum += products[i];
  }
  EXPECT_NEAR(rows.Gap(), sum, 1e-12);
}

// s·y + s Δy + y Δs + ω Δs'Δy' = centre, with the products Δs'Δy' of the step
// before, of which ω is the root of the share that it led, and as far as steps
// lead nothing is negative, and something 0.  Slacks change by the slopes and
// by what rows bend.
TEST(InteriorRows, FollowAStepOfTheUnknowns) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    InteriorRows rows;
    rows.Begin(Uniform(0.1, 2.0, &random), ArrayXd::Constant(kRows, kMu));
    const ArrayXd s = rows.slack, y = rows.dual;
    const ArrayXd first = Uniform(-3.0, 3.0, &random);
    const InteriorReach reach = rows.Follow(first, 0.0);
    const double centre = rows.Predict(reach);
    const double known = std::sqrt(std::min(reach.slack, reach.dual));

    double gap = 0.0, after = 0.0, of_slacks = 1.0, of_duals = 1.0;
    ArrayXd products(kRows);
    for (int i = 0; i < kRows; ++i) {
      const double ds = -first[i], dy = -y[i] * (s[i] + ds) / s[i];
      gap += s[i] * y[i];
      after += (s[i] + reach.slack * ds) * (y[i] + reach.dual * dy);
      products[i] = known * ds * dy;
      if (ds < 0.0) of_slacks = std::min(of_slacks, -s[i] / ds);
      if (dy < 0.0) of_duals = std::min(of_duals, -y[i] / dy);
    }
    EXPECT_NEAR(reach.slack, of_slacks, 1e-14);
    EXPECT_NEAR(reach.dual, of_duals, 1e-14);
    const double ratio = after / gap;
    EXPECT_NEAR(centre, ratio * ratio * ratio * gap / kRows, 1e-14);

    const ArrayXd second = Uniform(-3.0, 3.0, &random);
    const ArrayXd bends = Uniform(0.0, 0.2, &random);
    if (trial % 2 == 0) rows.Bend(bends);
    ArrayXd multipliers(kRows), squares(kRows);
    // In two parts.
    for (const auto& [at, n] : {std::pair{0, 20}, std::pair{20, kRows - 20}}) {
      rows.WriteMultipliers(centre, at, n, multipliers.data() + at);
      rows.WriteSquares(at, n, squares.data() + at);
    }
    const InteriorReach share = rows.Follow(second, centre).Times(0.9);
    rows.Move(share);
    for (int i = 0; i < kRows; ++i) {
      const double ds = (rows.slack[i] - s[i]) / share.slack;
      const double dy = (rows.dual[i] - y[i]) / share.dual;
      EXPECT_NEAR(ds, -second[i] - (trial % 2 == 0 ? bends[i] : 0.0), 1e-11);
      EXPECT_NEAR(squares[i], y[i] / s[i], 1e-13);
      // What does not depend on the step is in the right-hand side.
      EXPECT_NEAR(y[i] + dy + multipliers[i], y[i] * second[i] / s[i], 1e-10);
      EXPECT_NEAR(s[i] * y[i] + s[i] * dy + y[i] * ds + products[i], centre,
                  1e-10);
      EXPECT_GT(rows.slack[i], 0.0);
      EXPECT_GT(rows.dual[i], 0.0);
    }
  }
}

// More rows than are moved at once.
TEST(InteriorRows, PredictAndMoveManyAsEachAlone) {
  constexpr int kMany = 1000;
  const ArrayXd s = ArrayXd::LinSpaced(kMany, 0.1, 2.0);
  const ArrayXd slopes = ArrayXd::LinSpaced(kMany, -1.0, 0.9);
  InteriorRows all;
  all.Begin(s, ArrayXd::Constant(kMany, kMu));
  const InteriorReach reach = all.Follow(slopes, 0.0);
  double after = 0.0;
  for (int i = 0; i < kMany; ++i) {
    const double y = kMu / s[i], dy = -y * (s[i] - slopes[i]) / s[i];
    after += (s[i] - reach.slack * slopes[i]) * (y + reach.dual * dy);
  }
  const double left = after / (kMany * kMu);
  EXPECT_NEAR(all.Predict(reach), left * left * left * kMu, 1e-12);
  all.Move(reach.Times(0.5));
  for (int i = 0; i < kMany; ++i) {
    EXPECT_NEAR(all.slack[i], s[i] - 0.5 * reach.slack * slopes[i], 1e-15);
  }
}

// No row is in the way, and slacks that are known better are taken.
TEST(InteriorRows, GoTheWholeWayWhereNothingEnds) {
  InteriorRows rows;
  rows.Begin(ArrayXd::Constant(3, 1.0), ArrayXd::Constant(3, kMu));
  const InteriorReach reach = rows.Follow(ArrayXd::Constant(3, -1.0), 1.0);
  EXPECT_EQ(reach.slack, 1.0);
  EXPECT_EQ(reach.dual, 1.0);
  rows.Move(reach, ArrayXd::Constant(3, 2.5));
  EXPECT_EQ(rows.slack[1], 2.5);
  EXPECT_NEAR(rows.dual[1], kMu + (1.0 - kMu - kMu), 1e-15);
  InteriorRows none;
  none.Begin(ArrayXd(0), ArrayXd(0));
  EXPECT_EQ(none.Follow(ArrayXd(0), 0.0).Least(), 1.0);
}

}  // namespace
}  // namespace phongpd::internal
