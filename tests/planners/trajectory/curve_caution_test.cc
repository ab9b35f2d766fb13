// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_caution.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {
namespace {

constexpr double kPredicted = 0.1;

TEST(CurveCaution, BeginsWithoutAny) {
  EXPECT_TRUE(CurveCaution().shares().empty());
}

// One of eight costs more than it may: 0.3 of the gain.
TEST(CurveCaution, BlamesAPieceThatCostsTheOthersTheirGain) {
  CurveCaution caution;
  std::vector<double> slowings(8, 1.0);
  slowings[3] = 1.04;
  EXPECT_TRUE(caution.Learn(slowings, kPredicted));
  ASSERT_EQ(caution.shares().size(), 8u);
  // So that it costs 0.2 next time, where the cost falls with the share.
  EXPECT_NEAR(caution.shares()[3], 0.5, 1e-12);
  EXPECT_EQ(caution.shares()[2], 1.0);
  EXPECT_EQ(caution.shares()[4], 1.0);
}

TEST(CurveCaution, SaysThatAllAreToBlameWhereManyAre) {
  CurveCaution caution;
  std::vector<double> slowings(8, 1.0);
  slowings[0] = slowings[1] = slowings[2] = 1.05;
  EXPECT_FALSE(caution.Learn(slowings, kPredicted));
  EXPECT_LT(caution.shares()[1], 1.0);
  EXPECT_FALSE(CurveCaution().Learn(std::vector<double>(8, 1.0), kPredicted));
}

// What costs little, and not what costs something.
TEST(CurveCaution, TrustsAPieceMoreThatCostsNothing) {
  CurveCaution caution;
  caution.Learn({1.08, 1.08, 1.0, 1.0}, kPredicted);
  const std::vector<double> before = caution.shares();
  EXPECT_FALSE(caution.Learn({0.9, 1.01, 1.0, 1.0}, kPredicted));
  EXPECT_NEAR(caution.shares()[0], 1.2 * before[0], 1e-12);
  EXPECT_EQ(caution.shares()[1], before[1]);
  EXPECT_EQ(caution.shares()[2], 1.0);
  for (int i = 0; i < 20; ++i) caution.Learn({1.0, 1.0, 1.0, 1.0}, kPredicted);
  EXPECT_EQ(caution.shares(), std::vector<double>(4, 1.0));
}

// However often, and by however much a piece fails.
TEST(CurveCaution, NeverStopsAPiece) {
  CurveCaution caution;
  for (int i = 0; i < 50; ++i) caution.Learn({1e300, 1.0}, 1e-12);
  EXPECT_GE(caution.shares()[0], 1e-4);
  EXPECT_EQ(caution.shares()[1], 1.0);
}

TEST(CurveCaution, LeavesHalvesSomeRoom) {
  CurveCaution caution;
  caution.Halve();
  EXPECT_TRUE(caution.shares().empty());
  caution.Learn({2.0, 1.04, 1.0}, kPredicted);
  const std::vector<double> before = caution.shares();
  EXPECT_LT(before[0], 0.1);
  caution.Halve();
  EXPECT_EQ(caution.shares(),
            (std::vector<double>{0.1, 0.1, before[1], before[1], 1.0, 1.0}));
}

// A step changes durations by σ at most, and of a piece that is trusted less by
// nearly as much as those of its neighbours.
TEST(CurveCaution, IsKeptByTheProgram) {
  CurveProgramOptions options;
  options.limits.velocity.setConstant(1.0);
  options.limits.acceleration.setConstant(2.0);
  options.limits.jerk.setConstant(8.0);
  options.trust = 0.05;
  options.sigma = 0.1;
  const KnotCurve now = StopAtCorners(
      {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, options.limits, 3);
  const std::vector<PieceCells> cells(3);
  const auto difference = [&] {
    const std::vector<double> eta =
        SolveCurveProgram(now, cells, options).change.durations;
    double most = 0.0;
    for (const double change : eta) {
      EXPECT_LE(std::abs(change), options.sigma);
      most = std::max(most, std::abs(change));
    }
    EXPECT_GT(most, 0.1 * options.sigma);
    return std::abs(eta[1] - eta[0]);
  };
  const double free = difference();
  EXPECT_GT(free, 1e-3);
  options.caution = {1.0, 1e-3, 1.0};
  EXPECT_LT(difference(), 0.1 * free);
  // What each piece asks for, the worst of which all of them get.
  const std::vector<double> slowings = SlowingOfPieces(now, options.limits);
  ASSERT_EQ(slowings.size(), 3u);
  EXPECT_EQ(*std::max_element(slowings.begin(), slowings.end()),
            SlowingOf(now, options.limits));
  EXPECT_NEAR(slowings[0], slowings[2], 1e-12);
  EXPECT_LT(*std::min_element(slowings.begin(), slowings.end()), 1.0);
}

}  // namespace
}  // namespace phongpd::internal
