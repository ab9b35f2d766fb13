// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: both motions and their difference in rationals, durations summed
// without rounding.
#include "constraints/relative_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/mesh/mesh_error.h"
#include "tests/support/rationals.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Rational;
using testing::RationalPoint;

RationalPoint ExactAt(const CurvePiece& piece, const Rational& s) {
  RationalPoint result;
  for (int k = 0; k < 3; ++k) {
    std::vector<Rational> p;
    for (int i = 0; i <= piece.degree(); ++i) p.emplace_back(piece.point(i)[k]);
    for (std::size_t left = p.size() - 1; left > 0; --left) {
      for (std::size_t i = 0; i < left; ++i) {
        p[i] = (1 - s) * p[i] + s * p[i + 1];
      }
    }
    result[static_cast<std::size_t>(k)] = p[0];
  }
  return result;
}

// At rest before the beginning and after the end.
RationalPoint ExactAt(const Trajectory& motion, const Rational& time) {
  if (time <= 0) return ExactAt(motion.pieces().front(), Rational(0));
  Rational start = 0;
  for (const CurvePiece& piece : motion.pieces()) {
    const Rational h(piece.duration());
    if (time < start + h) return ExactAt(piece, (time - start) / h);
    start += h;
  }
  return ExactAt(motion.pieces().back(), Rational(1));
}

// How far the relative motion is from the exact one, in the middle and at
// shares of each of its pieces.
double WorstError(const Trajectory& a, const Trajectory& b, double b_time,
                  const RelativeMotion& seen) {
  double worst = 0.0;
  Rational start = 0;
  for (const CurvePiece& piece : seen.curve.pieces()) {
    const Rational h(piece.duration());
    for (const double share : {0.0, 0.125, 0.3, 0.5, 0.9}) {
      const Rational s(share), t = start + s * h;
      const RationalPoint p = ExactAt(a, t),
                          q = ExactAt(b, t + Rational(b_time)),
                          d = ExactAt(piece, s);
      Vector3d error;
      for (std::size_t k = 0; k < 3; ++k) {
        const Rational off = d[k] - (p[k] - q[k]);
        error[static_cast<int>(k)] = off.convert_to<double>();
      }
      worst = std::max(worst, error.norm());
    }
    start += h;
  }
  return worst;
}

Trajectory RandomMotion(int pieces, double size, double off, double seconds,
                        std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_int_distribution<int> degree(1, CurvePiece::kMaxDegree);
  const auto point = [&]() -> Vector3d {
    return size * Vector3d(unit(*random), unit(*random), unit(*random)) +
           Vector3d::Constant(off);
  };
  std::vector<CurvePiece> all;
  Vector3d at = point();
  for (int i = 0; i < pieces; ++i) {
    std::vector<Vector3d> points = {at};
    for (int n = degree(*random); n > 0; --n) points.push_back(point());
    at = points.back();
    all.emplace_back(points, seconds * std::exp(3.0 * unit(*random)));
  }
  return Trajectory(std::move(all));
}

TEST(RelativeMotion, IsTheDifferenceToWithinTheRoundingSaid) {
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double loosest = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double off = i % 3 == 0 ? 1e4 : 0.0;
    const double seconds = i % 4 == 0 ? 1e-3 : 0.7;
    const Trajectory a = RandomMotion(1 + i % 9, 1.0, off, seconds, &random);
    const Trajectory b = RandomMotion(1 + i % 7, 3.0, 0.0, seconds, &random);
    const double b_time = unit(random) * 1.5 * b.duration();
    const double until = a.duration() * (1.0 + 0.5 * unit(random));
    const RelativeMotion seen = RelativeMotionOf(a, b, until, b_time);
    EXPECT_NEAR(seen.curve.duration(), until, 1e-12 * until) << i;
    const double worst = WorstError(a, b, b_time, seen);
    EXPECT_LE(worst, seen.rounding) << i;
    EXPECT_LE(seen.rounding, 1e-9 * (3.0 + off)) << i;
    loosest = std::max(loosest, worst / seen.rounding);
  }
  EXPECT_GT(loosest, 1e-3);  // or the bound is no bound of this
}

TEST(RelativeMotion, RestsBeforeAndAfterTheMotions) {
  const Trajectory a = Trajectory::Along({{0, 0, 0}, {1, 0, 0}});
  const Trajectory b = Trajectory::Along({{0, 5, 0}, {0, 7, 0}});
  const auto at = [&](double until, double b_time, double t) -> Vector3d {
    return RelativeMotionOf(a, b, until, b_time).curve.At(t).position;
  };
  EXPECT_EQ(at(4.0, -2.0, 1.5), Vector3d(1, -5, 0));
  EXPECT_EQ(at(4.0, -2.0, 2.5), Vector3d(1, -6, 0));
  EXPECT_EQ(at(4.0, -2.0, 4.0), Vector3d(1, -7, 0));
  EXPECT_EQ(at(0.5, 3.0, 0.25), Vector3d(0.25, -7, 0));
  EXPECT_EQ(at(0.5, 0.5, 0.25), Vector3d(0.25, -6.5, 0));
}

// Knots that differ by rounding alone are one: no pieces of no duration.
TEST(RelativeMotion, JoinsKnotsThatAreOneButForRounding) {
  std::vector<CurvePiece> tenths, ones;
  for (int i = 0; i < 100; ++i) {
    const Vector3d p(i, 0.0, 0.0), q(i + 1.0, 0.0, 0.0);
    tenths.emplace_back(p, q, 0.1);
    if (i < 10) ones.emplace_back(q, p, 1.0), ones.emplace_back(p, q, 1e-30);
  }
  for (std::size_t i = 0; i + 1 < ones.size(); ++i) {
    ones[i] =
        CurvePiece(ones[i].front(), ones[i + 1].front(), ones[i].duration());
  }
  const Trajectory a(tenths), b(ones);
  const RelativeMotion seen = RelativeMotionOf(a, b, 12.0);
  EXPECT_LE(seen.curve.pieces().size(), 125u);
  EXPECT_TRUE(std::isfinite(seen.rounding));
}

TEST(RelativeMotion, RefusesWhatIsNoMotionAndNoTime) {
  const Trajectory a = Trajectory::Along({{0, 0, 0}, {1, 0, 0}});
  EXPECT_THROW(RelativeMotionOf(a, {}, 1.0), InputError);
  EXPECT_THROW(RelativeMotionOf({}, a, 1.0), InputError);
  EXPECT_THROW(RelativeMotionOf(a, a, 0.0), InputError);
  EXPECT_THROW(RelativeMotionOf(a, a, 1.0, std::nan("")), InputError);
}

}  // namespace
}  // namespace phongpd
