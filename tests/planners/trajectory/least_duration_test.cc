// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the top speed found by halving (tests/support/rest_to_rest.h).
#include "planners/trajectory/least_duration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/rest_to_rest.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

MotionLimits Some(double v, double a, double j) {
  MotionLimits limits;
  limits.velocity = {v, 2.0 * v, 3.0 * v};
  limits.acceleration = {a, 3.0 * a, 2.0 * a};
  limits.jerk = {j, j, 5.0 * j};
  return limits;
}

// From ways too short for the limit of acceleration to ways that are long at
// that of velocity, and limits of which each counts for some of them.
TEST(LeastDuration, IsThatOfTheSlowestAxisWithItsBestTopSpeed) {
  for (const double v : {0.01, 1.0, 30.0}) {
    for (const double a : {0.1, 2.0, 50.0}) {
      for (const double j : {0.5, 8.0, 1e4}) {
        const MotionLimits limits = Some(v, a, j);
        for (const double scale : {1e-6, 1e-2, 1.0, 100.0}) {
          const Vector3d way = scale * Vector3d(1.0, -2.0, 0.3);
          double truth = 0.0;
          for (int k = 0; k < 3; ++k) {
            truth = std::max(
                truth,
                testing::RestToRest(std::abs(way[k]), limits.velocity[k],
                                    limits.acceleration[k], limits.jerk[k]));
          }
          EXPECT_NEAR(LeastDuration(way, limits, true), truth, 1e-9 * truth)
              << v << " " << a << " " << j << " " << scale;
        }
      }
    }
  }
}

TEST(LeastDuration, OfNormsIsThatOfTheStraightLine) {
  MotionLimits limits = Some(1.0, 2.0, 8.0);
  limits.by_norm = true;
  EXPECT_NEAR(LeastDuration({3.0, 4.0, 12.0}, limits, true),
              testing::RestToRest(13.0, 1.0, 2.0, 8.0), 1e-9);
}

TEST(LeastDuration, WithoutRestIsAtTheLimitOfVelocity) {
  EXPECT_DOUBLE_EQ(LeastDuration({1.0, -4.0, 3.0}, Some(1.0, 2.0, 8.0), false),
                   2.0);
}

// Limits that are none are left out, and nothing becomes NaN.
TEST(LeastDuration, TakesTheLimitsThatThereAre) {
  const double none = MotionLimits::kNone;
  const Vector3d way(2.0, 0.0, 0.0);
  const auto with = [&](double v, double a, double j) {
    MotionLimits limits;
    limits.velocity.setConstant(v);
    limits.acceleration.setConstant(a);
    limits.jerk.setConstant(j);
    return LeastDuration(way, limits, true);
  };
  EXPECT_DOUBLE_EQ(with(0.5, none, none), 4.0);
  EXPECT_DOUBLE_EQ(with(none, 2.0, none), 2.0);       // 2 √(d/a)
  EXPECT_DOUBLE_EQ(with(none, none, 64.0), 1.0);      // ∛(32 d/j)
  EXPECT_DOUBLE_EQ(with(1.0, 2.0, none), 2.5);        // v/a + d/v
  EXPECT_DOUBLE_EQ(with(1.0, none, 4.0), 2.0 + 1.0);  // d/v + 2 √(v/j)
  EXPECT_EQ(LeastDuration(Vector3d::Zero(), Some(1.0, 2.0, 8.0), true), 0.0);
}

}  // namespace
}  // namespace phongpd
