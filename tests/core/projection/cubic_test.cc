// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: cubics multiplied out from chosen roots; those of any coefficients by
// bisection between critical points, in 128-bit arithmetic.
#include "core/projection/cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace phongpd {
namespace {

Cubic FromRoots(double a, double r0, double r1, double r2) {
  return {-a * r0 * r1 * r2, a * (r0 * r1 + r1 * r2 + r2 * r0),
          -a * (r0 + r1 + r2), a};
}

double DistanceTo(const CubicRoots& roots, double s) {
  double distance = std::numeric_limits<double>::infinity();
  for (const double root : roots) {
    distance = std::min(distance, std::abs(root - s));
  }
  return distance;
}

TEST(Cubic, FindsThreeSimpleRootsAtAnyScale) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double scale : {1.0, 1e-100, 1e100, 1e-30, 1e7}) {
    for (int i = 0; i < 2000; ++i) {
      const double r0 = uniform(engine) * scale;
      const double r1 = uniform(engine) * scale;
      const double r2 = uniform(engine) * scale;
      // Conditioning: rounding of the coefficients over the gap to the others.
      const double gap =
          std::min({std::abs(r0 - r1), std::abs(r1 - r2), std::abs(r2 - r0)});
      if (gap < 1e-2 * scale) continue;
      const CubicRoots roots =
          SolveCubic(FromRoots(scale > 1.0 ? 1e-5 : 1.0, r0, r1, r2));
      ASSERT_EQ(roots.count, 3);
      EXPECT_TRUE(std::is_sorted(roots.begin(), roots.end()));
      for (const double r : {r0, r1, r2}) {
        EXPECT_LT(DistanceTo(roots, r), 1e-11 * scale);
      }
    }
  }
}

TEST(Cubic, FindsDoubleAndTripleRoots) {
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 5000; ++i) {
    const double r0 = uniform(engine), r1 = uniform(engine);
    const CubicRoots twice = SolveCubic(FromRoots(1.0, r0, r0, r1));
    if (std::abs(r0 - r1) > 0.05) {
      EXPECT_LT(DistanceTo(twice, r0), 1e-6);
      EXPECT_LT(DistanceTo(twice, r1), 1e-12);
    }
    const CubicRoots thrice = SolveCubic(FromRoots(1.0, r0, r0, r0));
    EXPECT_LT(DistanceTo(thrice, r0), 3e-5);
  }
}

TEST(Cubic, FindsRootsWhenLeadingCoefficientsVanish) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const double tiny : {0.0, 1e-18, -1e-18, 1e-60, 5e-324}) {
    for (int i = 0; i < 1000; ++i) {
      const double r0 = uniform(engine), r1 = r0 + 0.1 + std::abs(r0);
      const Cubic quadratic = {r0 * r1, -r0 - r1, 1.0, tiny};
      const CubicRoots two = SolveCubic(quadratic, -2.0, 2.5);
      ASSERT_EQ(two.count, 2);
      EXPECT_LT(DistanceTo(two, r0), 1e-13);
      EXPECT_LT(DistanceTo(two, r1), 1e-13);
      const CubicRoots one = SolveCubic({-r0, 1.0, tiny, tiny}, -2.0, 2.0);
      ASSERT_EQ(one.count, 1);
      EXPECT_LT(DistanceTo(one, r0), 1e-15);
    }
  }
  EXPECT_EQ(SolveCubic({1.0, 0.0, 0.0, 0.0}).count, 0);
  EXPECT_EQ(SolveCubic({0.0, 0.0, 0.0, 0.0}).count, 0);
}

TEST(Cubic, KeepsSmallRootsBesideHugeOnes) {
  const CubicRoots roots = SolveCubic(FromRoots(1.0, 1e-20, 1.0, 1e20));
  ASSERT_EQ(roots.count, 3);
  EXPECT_NEAR(roots.root[0] / 1e-20, 1.0, 1e-12);
  EXPECT_NEAR(roots.root[1], 1.0, 1e-12);
  EXPECT_NEAR(roots.root[2] / 1e20, 1.0, 1e-12);
}

TEST(Cubic, GivesOnlyRootsInTheInterval) {
  const Cubic c = FromRoots(2.0, -0.5, 0.25, 0.75);
  EXPECT_EQ(SolveCubic(c, 0.0, 0.5).count, 1);
  EXPECT_EQ(SolveCubic(c, 0.3, 0.7).count, 0);
  EXPECT_EQ(SolveCubic(c, 0.25, 0.75).count, 2);  // closed
  EXPECT_EQ(SolveCubic(c, 1.0, 0.0).count, 0);
}

using Quad = boost::multiprecision::cpp_bin_float_quad;

Quad ValueOf(const Cubic& c, const Quad& s) {
  return ((c[3] * s + c[2]) * s + c[1]) * s + c[0];
}

// Zeros of the derivative in (low, high), ascending.
std::vector<Quad> CriticalPointsOf(const Cubic& c, double low, double high) {
  std::vector<Quad> points;
  const Quad a = Quad(3.0) * c[3], b = c[2], d = c[1];
  const Quad discriminant = b * b - a * d;
  if (discriminant < 0) return points;
  const Quad m = -(b + (b < 0 ? -sqrt(discriminant) : sqrt(discriminant)));
  for (const auto& [over, under] : {std::pair(m, a), std::pair(d, m)}) {
    if (under == 0) continue;
    const Quad s = over / under;
    if (s > low && s < high) points.push_back(s);
  }
  std::sort(points.begin(), points.end());
  return points;
}

struct TrueRoots {
  std::vector<Quad> roots;
  double least_extremum = 1e300;  // |f| at critical points, over Σ|c|
};

TrueRoots RootsOf(const Cubic& c, double low, double high) {
  TrueRoots truth;
  std::vector<Quad> ends = CriticalPointsOf(c, low, high);
  for (const Quad& s : ends) {
    const Quad size =
        std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]) + std::abs(c[3]);
    truth.least_extremum = std::min(
        truth.least_extremum, static_cast<double>(abs(ValueOf(c, s)) / size));
  }
  ends.insert(ends.begin(), low);
  ends.push_back(high);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    Quad a = ends[i], b = ends[i + 1];
    const bool rising = ValueOf(c, a) < 0;
    if (rising == (ValueOf(c, b) < 0)) continue;
    for (int k = 0; k < 120; ++k) {
      const Quad middle = (a + b) / 2;
      ((ValueOf(c, middle) < 0) == rising ? a : b) = middle;
    }
    truth.roots.push_back((a + b) / 2);
  }
  return truth;
}

void ExpectTrueRoots(const Cubic& c, double low, double high, int* counted) {
  const TrueRoots truth = RootsOf(c, low, high);
  // Whether it touches zero, or an end does, rounding may decide.
  const Quad at_low = abs(ValueOf(c, low)), at_high = abs(ValueOf(c, high));
  if (truth.least_extremum < 1e-14 || at_low < 1e-14 || at_high < 1e-14) return;
  const CubicRoots roots = SolveCubic(c, low, high);
  ASSERT_EQ(roots.count, static_cast<int>(truth.roots.size()));
  for (std::size_t i = 0; i < truth.roots.size(); ++i) {
    const Quad s = truth.roots[i];
    const Quad slope =
        abs((Quad(3.0) * c[3] * s + Quad(2.0) * c[2]) * s + c[1]);
    if (slope < 1e-2) continue;  // a fold
    EXPECT_LT(static_cast<double>(abs(roots.root[i] - s)), 1e-12);
    ++*counted;
  }
}

TEST(Cubic, RootsAwayFromFoldsAreThoseOf128BitArithmetic) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int counted = 0;
  for (int i = 0; i < 8000; ++i) {
    Cubic c = {uniform(engine), uniform(engine), uniform(engine),
               uniform(engine)};
    // As of prisms: nearly linear ones, too.
    if (i % 2 == 0) c = {0.3 * c[0], c[1], 1e-2 * c[2], 1e-4 * c[3]};
    const double a = uniform(engine), b = uniform(engine);
    ASSERT_NO_FATAL_FAILURE(
        ExpectTrueRoots(c, std::min(a, b), std::max(a, b), &counted));
    ASSERT_NO_FATAL_FAILURE(ExpectTrueRoots(c, -1.0, 1.0, &counted));
  }
  EXPECT_GT(counted, 5000);
}

// Two roots a little apart, and the same lifted off zero: as many as there are.
TEST(Cubic, CountsRootsOnBothSidesOfAFold) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  int counted = 0;
  for (const double gap : {1e-3, 1e-4, 1e-5, 1e-6}) {
    for (int i = 0; i < 500; ++i) {
      const double r = uniform(engine), other = uniform(engine);
      if (std::abs(r - other) < 0.1) continue;
      Cubic c = FromRoots(1.0, r - gap, r + gap, other);
      ASSERT_NO_FATAL_FAILURE(ExpectTrueRoots(c, -1.0, 1.0, &counted));
      c[0] += (r > other ? 2.0 : -2.0) * gap * gap * std::abs(r - other);
      ASSERT_NO_FATAL_FAILURE(ExpectTrueRoots(c, -1.0, 1.0, &counted));
    }
  }
  EXPECT_GT(counted, 2000);
}

TEST(Cubic, NeverGivesNaN) {
  const double special[] = {0.0,    -0.0,  1.0,   -1.0,   5e-324,   1e-308,
                            1e-150, 1e150, 1e308, -1e308, INFINITY, NAN};
  for (const double c0 : special) {
    for (const double c1 : special) {
      for (const double c2 : special) {
        for (const double c3 : special) {
          for (const CubicRoots& roots :
               {SolveCubic({c0, c1, c2, c3}),
                SolveCubic({c0, c1, c2, c3}, -1.0, 1.0)}) {
            ASSERT_LE(roots.count, 3);
            for (const double root : roots) ASSERT_FALSE(std::isnan(root));
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace phongpd
