// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of a given duration.  Truth: the closed form of the least jerk,
// 720 L²/T⁵, sums of samples, the judges.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "constraints/curve_judge.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/trajectory_problem.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_problems.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

CurveOptions Options() {
  CurveOptions options;
  options.limits = testing::PlainLimits();
  return options;
}

// ∫ |q'''|² dt, by samples.
double Jerk(const Trajectory& curve) {
  double sum = 0.0;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    sum += curve.At((i + 0.5) / n * curve.duration()).jerk.squaredNorm();
  }
  return sum * curve.duration() / n;
}

TEST(OptimizeCurveOfDuration, HasTheLeastJerkInTheOpen) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Vector3d way(1.2, -0.9, 0.4);
  CurveOptions options = Options();
  for (const double duration : {4.0, 10.0}) {
    options.duration = duration;
    const CurveSummary summary =
        OptimizeCurve(space, 2.0, {Vector3d::Zero(), way}, options);
    ASSERT_FALSE(summary.trajectory.empty());
    EXPECT_NEAR(summary.trajectory.duration(), duration, 1e-9);
    const double least = 720.0 * way.squaredNorm() / std::pow(duration, 5);
    EXPECT_GE(Jerk(summary.trajectory), 0.999 * least);
    EXPECT_LE(Jerk(summary.trajectory), 1.02 * least);
    EXPECT_TRUE(BoundLimitUse(summary.trajectory, options.limits).IsKept());
  }
  // Without time to look for it: the first answer, in the time asked for.
  options.time_limit = 1e-9;
  const CurveSummary first =
      OptimizeCurve(space, 2.0, {Vector3d::Zero(), way}, options);
  EXPECT_EQ(first.status, PathStatus::kTimeLimit);
  EXPECT_NEAR(first.trajectory.duration(), options.duration, 1e-9);
}

TEST(OptimizeCurveOfDuration, SaysTheLeastThatIsKnown) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  CurveOptions options = Options();
  options.duration = 1.0;  // 2 m at 1 m/s at most
  const CurveSummary summary = OptimizeCurve(
      space, 2.0, {Vector3d::Zero(), Vector3d(2.0, 0.0, 0.0)}, options);
  EXPECT_EQ(summary.status, PathStatus::kDurationTooShort);
  EXPECT_TRUE(summary.trajectory.empty());
  EXPECT_GE(summary.duration, 2.7 - 1e-9);
  EXPECT_LE(summary.duration, 1.05 * 2.7);
}

TEST(OptimizeCurveOfDurationCampaign, IsCalmerThanTheFastestSlowedDown) {
  const long seeds = testing::CampaignCases(1, 10);
  long cases = 0, wrong = 0;
  for (const std::string& family : testing::CurveFamilies()) {
    for (long seed = 1; seed <= seeds; ++seed) {
      const testing::FreePath one =
          testing::PlanFreePath(family, static_cast<std::uint64_t>(seed));
      CurveOptions options = Options();
      if (seed % 2 == 0) options.limits.by_norm = true;
      const CurveSummary fast =
          OptimizeCurve(one.space, one.diagonal, one.path, options);
      for (const double factor : {1.05, 1.5, 3.0}) {
        options.duration = factor * fast.duration;
        const CurveSummary calm =
            OptimizeCurve(one.space, one.diagonal, one.path, options);
        ++cases;
        ASSERT_FALSE(calm.trajectory.empty()) << family << ' ' << factor;
        EXPECT_TRUE(CheckCurve(one.space, calm.trajectory).IsFree());
        EXPECT_TRUE(BoundLimitUse(calm.trajectory, options.limits).IsKept());
        EXPECT_NEAR(calm.trajectory.duration(), options.duration,
                    1e-9 * options.duration);
        EXPECT_LT(calm.trajectory.JointGap(2), 1e-6);
        // 1.05: limits leave little room to be calmer.
        const double slowed = Jerk(fast.trajectory.Slowed(factor));
        EXPECT_LT(Jerk(calm.trajectory), (factor > 1.2 ? 0.9 : 1.0) * slowed)
            << family << ' ' << factor;
        wrong += ::testing::Test::HasFailure();
        if (wrong > 0) FAIL() << family << ' ' << seed;
      }
    }
  }
  testing::ReportCampaign({"5 exact motion checks",
                           "curves of given durations, least jerk", cases,
                           wrong, 0.0, 0.0, "", 0});
}

TEST(OptimizeCurveOfDuration, RefusesWhatItDoesNotDo) {
  const auto expect_error = [](const CurveOptions& options) {
    testing::ExpectRefused([&] { options.Validate(); },
                           "curve: duration: expected");
  };
  CurveOptions options = Options();
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    options.duration = bad;
    expect_error(options);
  }
  options.duration = 5.0;
  options.end.velocity[0] = 0.1;
  expect_error(options);
  options.end = {};
  CurveVia rest;
  rest.tolerance = 0.1;
  rest.dwell = 1.0;
  options.via = {rest};
  expect_error(options);
}

}  // namespace
}  // namespace phongpd
