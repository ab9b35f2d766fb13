// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: power series and closed forms of the curves, and dense samples.
#include "constraints/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// q(t) = t³ (1, 2, −1) + (0, t, 5) for 0 ≤ t ≤ h: its Bézier points are the
// blossoms of t³ and t.
CurvePiece Cubic(double h) {
  const Vector3d cube(1.0, 2.0, -1.0), line(0.0, 1.0, 0.0), at(0.0, 0.0, 5.0);
  return CurvePiece({at, at + h / 3.0 * line, at + 2.0 * h / 3.0 * line,
                     at + h * line + h * h * h * cube},
                    h);
}

TEST(Trajectory, HasTheDerivativesOfItsPolynomial) {
  const Trajectory curve({Cubic(2.0)});
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const Trajectory::Sample sample = curve.At(t);
    const Vector3d cube(1.0, 2.0, -1.0);
    EXPECT_LT((sample.position - (t * t * t * cube + Vector3d(0, t, 5))).norm(),
              1e-14);
    EXPECT_LT((sample.velocity - (3 * t * t * cube + Vector3d(0, 1, 0))).norm(),
              1e-13);
    EXPECT_LT((sample.acceleration - 6 * t * cube).norm(), 1e-13);
    EXPECT_LT((sample.jerk - 6 * cube).norm(), 1e-13);
  }
}

TEST(Trajectory, KeepsItsCurveWhenSplitOrElevated) {
  std::mt19937_64 random(41);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int degree = 1; degree <= CurvePiece::kMaxDegree; ++degree) {
    std::vector<Vector3d> points;
    for (int i = 0; i <= degree; ++i) {
      points.push_back({unit(random), unit(random), unit(random)});
    }
    const CurvePiece piece(points, 3.0);
    const auto part = piece.Split(0.3);
    EXPECT_EQ(part[0].front(), piece.front());
    EXPECT_EQ(part[1].back(), piece.back());
    EXPECT_EQ(part[0].back(), part[1].front());
    EXPECT_DOUBLE_EQ(part[0].duration() + part[1].duration(), 3.0);
    for (double s = 0.0; s <= 1.0; s += 0.125) {
      EXPECT_LT((part[0].At(s) - piece.At(0.3 * s)).norm(), 1e-15);
      EXPECT_LT((part[1].At(s) - piece.At(0.3 + 0.7 * s)).norm(), 1e-15);
      if (degree < CurvePiece::kMaxDegree) {
        EXPECT_LT((piece.Elevated().At(s) - piece.At(s)).norm(), 1e-15);
      }
      const Vector3d on_chord = (1.0 - s) * piece.front() + s * piece.back();
      EXPECT_LE((piece.At(s) - on_chord).norm(), piece.Bend() + 1e-15);
    }
  }
}

TEST(Trajectory, MeasuresArcsInClosedForm) {
  // y = x² for 0 ≤ x ≤ 1: √5/2 + asinh(2)/4.
  const Trajectory parabola(
      {CurvePiece({{0, 0, 0}, {0.5, 0, 0}, {1, 1, 0}}, 7.0)});
  EXPECT_NEAR(parabola.ArcLength(), std::sqrt(5.0) / 2 + std::asinh(2.0) / 4,
              1e-9);
  // A cusp: (s³, s²) for −1 ≤ s ≤ 1, of length 2(13√13 − 8)/27.
  const Trajectory cusp({CurvePiece(
      {{-1, 1, 0}, {1, -1.0 / 3.0, 0}, {-1, -1.0 / 3.0, 0}, {1, 1, 0}}, 1.0)});
  EXPECT_NEAR(cusp.ArcLength(), 2.0 * (13.0 * std::sqrt(13.0) - 8.0) / 27.0,
              1e-7);
  EXPECT_DOUBLE_EQ(
      Trajectory::Along({{0, 0, 0}, {3, 4, 0}, {3, 4, 12}}).ArcLength(), 17.0);
}

TEST(Trajectory, BoundsLimitsFromAboveAndClosely) {
  std::mt19937_64 random(42);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  MotionLimits limits;
  limits.velocity = {1.0, 2.0, 3.0};
  limits.acceleration = {5.0, 5.0, 9.0};
  limits.jerk = {50.0, 60.0, 70.0};
  for (int round = 0; round < 40; ++round) {
    limits.by_norm = round % 2 == 1;
    std::vector<Vector3d> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back({unit(random), unit(random), unit(random)});
    }
    const Trajectory curve({CurvePiece(points, 1.0 + unit(random) * 0.5)});
    LimitUse sampled;
    const auto share = [&](const Vector3d& x, const Vector3d& limit) {
      return limits.by_norm ? x.norm() / limit[0]
                            : x.cwiseAbs().cwiseQuotient(limit).maxCoeff();
    };
    for (const Trajectory::Sample& s : curve.Samples(5000.0)) {
      sampled.velocity =
          std::max(sampled.velocity, share(s.velocity, limits.velocity));
      sampled.acceleration = std::max(
          sampled.acceleration, share(s.acceleration, limits.acceleration));
      sampled.jerk = std::max(sampled.jerk, share(s.jerk, limits.jerk));
    }
    const LimitUse bound = BoundLimitUse(curve, limits, 6);
    EXPECT_GE(bound.velocity, sampled.velocity);
    EXPECT_GE(bound.acceleration, sampled.acceleration);
    EXPECT_GE(bound.jerk, sampled.jerk);
    EXPECT_LE(bound.velocity, 1.01 * sampled.velocity);
    EXPECT_LE(bound.acceleration, 1.01 * sampled.acceleration);
    EXPECT_LE(bound.jerk, 1.01 * sampled.jerk);
    // Slowed by what is needed it keeps them, and by less it does not.
    const double f = bound.SlowingNeeded();
    EXPECT_TRUE(
        BoundLimitUse(curve.Slowed(f * (1 + 1e-12)), limits, 6).IsKept());
    EXPECT_FALSE(BoundLimitUse(curve.Slowed(0.99 * f), limits, 6).IsKept());
  }
}

// Pieces of somebody else's spline meet to rounding.
TEST(Trajectory, JoinsWhatMeetsButForRounding) {
  const Vector3d a(0, 0, 0), b(100, 1, 0), c(200, 5, -3);
  const Vector3d near = b + Vector3d(0.0, 3e-12, -4e-12);
  double moved = -1.0;
  const Trajectory curve =
      Trajectory::Joined({{a, b, 1.0}, {near, c, 2.0}, {c, a, 1.0}}, &moved);
  EXPECT_EQ(curve.pieces()[1].front(), b);
  EXPECT_EQ(curve.pieces()[1].back(), c);
  EXPECT_EQ(curve.duration(), 4.0);
  EXPECT_GE(moved, (near - b).norm());
  EXPECT_NEAR(moved, 5e-12, 1e-14);

  Trajectory::Joined({{a, b, 1.0}, {b, c, 2.0}}, &moved);
  EXPECT_EQ(moved, 0.0);
  EXPECT_TRUE(Trajectory::Joined({}, &moved).empty());
  // 2⁻⁴⁰ of 200 is 1.8e-10.
  const Vector3d far = b + Vector3d(0.0, 1e-9, 0.0);
  testing::ExpectRefused(
      [&] {
        Trajectory::Joined({{a, b, 1.0}, {far, c, 2.0}}, &moved);
      },
      "piece 1");
}

TEST(Trajectory, TellsHowFarItsJointsAreFromSmooth) {
  const Trajectory corner =
      Trajectory::Along({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
  EXPECT_DOUBLE_EQ(corner.JointGap(1), std::sqrt(2.0));
  const auto half = Cubic(2.0).Split(0.5);
  const Trajectory smooth({half[0], half[1]});
  EXPECT_LT(smooth.JointGap(1), 1e-13);
  EXPECT_LT(smooth.JointGap(2), 1e-12);
}

TEST(Trajectory, SamplesEndsAndEqualSteps) {
  const auto samples = Trajectory({Cubic(2.0)}).Samples(3.0);
  ASSERT_EQ(samples.size(), 7U);
  EXPECT_DOUBLE_EQ(samples[1].time, 1.0 / 3.0);
  EXPECT_EQ(samples.back().time, 2.0);
  EXPECT_EQ(samples.back().position, Cubic(2.0).back());
}

TEST(Trajectory, EndsWhereItsLastPieceEndsHoweverDurationsRound) {
  std::vector<CurvePiece> pieces;
  for (int i = 0; i < 50; ++i) {
    pieces.emplace_back(Vector3d(i, 0.1 * i, 0),
                        Vector3d(i + 1, 0.1 * (i + 1), 0), 0.1 + i / 7.0);
  }
  const Trajectory curve(pieces);
  EXPECT_EQ(curve.At(curve.duration()).position, curve.pieces().back().back());
  EXPECT_EQ(curve.Samples(3.0).back().position, curve.pieces().back().back());
}

TEST(Trajectory, RefusesWhatIsNoMotionInOneLine) {
  EXPECT_NE(testing::ErrorOf([] {
              CurvePiece(Vector3d::Zero(), Vector3d::Zero(), 0.0);
            }).find("duration above 0"),
            std::string::npos);
  EXPECT_NE(testing::ErrorOf([] {
              CurvePiece(std::vector<Vector3d>(9, Vector3d::Zero()), 1.0);
            }).find("2 to 8 points"),
            std::string::npos);
  EXPECT_NE(testing::ErrorOf([] {
              CurvePiece(Vector3d::Constant(NAN), Vector3d::Zero(), 1.0);
            }).find("finite"),
            std::string::npos);
  EXPECT_NE(testing::ErrorOf([] {
              Trajectory({CurvePiece(Vector3d::Zero(), Vector3d::Ones(), 1.0),
                          CurvePiece(Vector3d::Zero(), Vector3d::Ones(), 1.0)});
            }).find("piece 1 does not begin where piece 0 ends"),
            std::string::npos);
  EXPECT_NE(testing::ErrorOf([] {
              Trajectory({Cubic(2.0)}).Samples(0.0);
            }).find("rate:"),
            std::string::npos);
  MotionLimits limits;
  limits.acceleration[1] = -2.0;
  EXPECT_NE(
      testing::ErrorOf([&] { limits.Validate(); }).find("acceleration of y"),
      std::string::npos);
}

}  // namespace
}  // namespace phongpd
