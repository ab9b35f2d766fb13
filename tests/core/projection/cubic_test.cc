// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: cubics multiplied out from chosen roots.
#include "core/projection/cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

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
