// SPDX-License-Identifier: GPL-3.0-or-later
// Curves that begin or end in motion.  Truth: closed forms of stops, Bézier
// points of the ends, the exact judge of segments.
#include "planners/trajectory/curve_ends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/mesh/mesh_error.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/trajectory_problem.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_problems.h"
#include "tests/support/expect_refused.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::KnotCurve;
using testing::PlainLimits;

constexpr double kV = 1.0, kA = 2.0, kJ = 10.0;  // of PlainLimits

CurveOptions With(const MotionLimits& limits) {
  CurveOptions options;
  options.limits = limits;
  options.preset = Preset::kFast;
  return options;
}

// From a speed to rest, at most acceleration a and jerk j.
double StopTime(double v, double a, double j) {
  return v * j >= a * a ? v / a + a / j : 2.0 * std::sqrt(v / j);
}

TEST(CurveEnds, StopsStraightInTheLeastTime) {
  for (const double speed : {1e-6, 0.1, 0.45, 0.7, 1.0}) {
    for (const Vector3d& direction :
         {Vector3d(1, 0, 0), Vector3d(0.6, -0.8, 0.0)}) {
      KnotCurve::State state;
      state.v = speed * direction;
      const double stretch = 1.0 / direction.cwiseAbs().maxCoeff();
      const double time = StopTime(speed, kA * stretch, kJ * stretch);
      const KnotCurve stop = internal::StopsFrom(state, PlainLimits(), 1.0)[0];
      EXPECT_NEAR(stop.Duration(), time, 2e-6 * time);
      EXPECT_LT((stop.knots.back().p - 0.5 * time * state.v).norm(),
                2e-6 * time * speed);
      EXPECT_TRUE(internal::IsAtRest(stop.knots.back()));
    }
  }
  // Of one that brakes already, at the limit: goes on, and lets go.
  KnotCurve::State braking;
  braking.v = Vector3d(0.3, 0, 0);
  braking.a = Vector3d(-kA, 0, 0);
  EXPECT_NEAR(internal::StopsFrom(braking, PlainLimits(), 1.0)[0].Duration(),
              0.05 + kA / kJ, 2e-6);
}

// A state that can go on within the limits: also backwards, as both ends do.
CurveEnd RandomEnd(bool by_norm, std::mt19937_64* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_int_distribution<int> kind(0, 5);
  const auto vector = [&](double size) {
    const Vector3d v(unit(*random), unit(*random), unit(*random));
    return Vector3d((by_norm ? size / std::max(1.0, v.norm()) : size) * v);
  };
  CurveEnd end;
  const int which = kind(*random);
  end.velocity = vector(kV);
  if (which == 1) end.velocity = Vector3d(kV, 0.0, 0.0);  // at the limit
  if (which >= 3) end.acceleration = vector(kA);
  if (which == 4) end.velocity.setZero();
  if (which == 5) end.acceleration = -0.5 * end.velocity;
  for (int i = 0; i < 40; ++i) {  // until it is allowed
    CurveOptions options = With(PlainLimits(by_norm));
    options.start = options.end = end;
    try {
      options.Validate();
      break;
    } catch (const InputError&) {
      end.velocity *= 0.9;
      end.acceleration *= 0.9;
    }
  }
  return end;
}

void ExpectEnd(const CurvePiece& piece, bool is_first, const CurveEnd& end) {
  const int n = piece.degree(), step = is_first ? 1 : -1;
  ASSERT_EQ(n, 5);
  const auto b = [&](int i) { return piece.point(is_first ? i : n - i); };
  const double h = piece.duration();
  const Vector3d v = step * (n / h) * (b(1) - b(0));
  const Vector3d a = n * (n - 1) / (h * h) * (b(2) - 2.0 * b(1) + b(0));
  EXPECT_LT((v - end.velocity).norm(), 1e-8 * kV);
  EXPECT_LT((a - end.acceleration).norm(), 1e-6 * kA);
}

void ExpectCertifiedWithEnds(const FreeSpace& space, const Path& path,
                             const CurveOptions& options,
                             const CurveSummary& summary) {
  ASSERT_NO_FATAL_FAILURE(
      testing::ExpectCertified(space, path, options.limits, summary));
  const std::vector<CurvePiece>& pieces = summary.trajectory.pieces();
  ExpectEnd(pieces.front(), true, options.start);
  ExpectEnd(pieces.back(), false, options.end);
}

TEST(OptimizeCurveEnds, GoesThroughAtFullSpeed) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Path path = {Vector3d::Zero(), Vector3d(3.0, 0.0, 0.0)};
  CurveOptions options = With(PlainLimits());
  options.preset = Preset::kBalanced;
  options.start.velocity = options.end.velocity = Vector3d(kV, 0.0, 0.0);
  const CurveSummary summary = OptimizeCurve(space, 3.0, path, options);
  ExpectCertifiedWithEnds(space, path, options, summary);
  EXPECT_GE(summary.duration, 3.0 / kV * (1.0 - 1e-12));
  EXPECT_LE(summary.duration, 1.02 * 3.0 / kV);
  // From full speed to rest: the stop, and the way before it at full speed.
  options.end = {};
  const double stop = StopTime(kV, kA, kJ);
  const double least = (3.0 - 0.5 * stop * kV) / kV + stop;
  const CurveSummary to_rest = OptimizeCurve(space, 3.0, path, options);
  ExpectCertifiedWithEnds(space, path, options, to_rest);
  EXPECT_GE(to_rest.duration, least * (1.0 - 1e-12));
  EXPECT_LE(to_rest.duration, 1.04 * least);
}

TEST(OptimizeCurveEnds, AreKeptInTheOpen) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  std::mt19937_64 random(3111);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const long cases = testing::CampaignCases(30, 1'000);
  std::vector<double> gains;
  for (long i = 0; i < cases; ++i) {
    const Path path = {Vector3d(place(random), place(random), place(random)),
                       Vector3d(place(random), place(random), place(random))};
    const bool by_norm = i % 3 == 0;
    CurveOptions options = With(PlainLimits(by_norm));
    if (i % 4 != 1) options.start = RandomEnd(by_norm, &random);
    if (i % 4 != 2) options.end = RandomEnd(by_norm, &random);
    const CurveSummary summary = OptimizeCurve(space, 2.0, path, options);
    ExpectCertifiedWithEnds(space, path, options, summary);
    gains.push_back(summary.stops_duration / summary.duration);
    if (::testing::Test::HasFailure()) FAIL() << i;
  }
  std::sort(gains.begin(), gains.end());
  EXPECT_GT(gains[gains.size() / 2], 1.2);
}

// All of them certified, or refused where the straight stop does collide.
TEST(OptimizeCurveEndsCampaign, AreKeptInClutterOrRefusedWithTheReason) {
  std::mt19937_64 random(3112);
  const long each = testing::CampaignCases(4, 40);
  const int seeds = testing::IsLongCampaign() ? 2 : 1;
  long certified = 0, refused = 0, wrong = 0;
  for (const std::string& family : testing::CurveFamilies()) {
    for (int seed = 1; seed <= seeds; ++seed) {
      const testing::FreePath one =
          testing::PlanFreePath(family, static_cast<std::uint64_t>(seed));
      for (long i = 0; i < each; ++i) {
        const bool by_norm = i % 3 == 0;
        CurveOptions options = With(PlainLimits(by_norm));
        if (i % 4 != 1) options.start = RandomEnd(by_norm, &random);
        if (i % 4 != 2) options.end = RandomEnd(by_norm, &random);
        if (i % 2 == 1) {  // long stops
          options.limits.acceleration *= 0.2;
          options.start.acceleration *= 0.1;
          options.end.acceleration *= 0.1;
        }
        try {
          options.Validate();
          const CurveSummary summary =
              OptimizeCurve(one.space, one.diagonal, one.path, options);
          ExpectCertifiedWithEnds(one.space, one.path, options, summary);
          ++certified;
        } catch (const InputError& error) {
          const std::string text = error.what();
          ++refused;
          const bool is_start = text.find("curve: start velocity") == 0;
          EXPECT_TRUE(is_start || text.find("curve: end velocity") == 0);
          EXPECT_NE(text.find("is free for"), std::string::npos) << text;
          EXPECT_EQ(text.find('\n'), std::string::npos) << text;
          // The chord of a collision-free stop would be free.
          KnotCurve::State state;
          state.p = is_start ? one.path.front() : one.path.back();
          state.v = is_start ? options.start.velocity
                             : Vector3d(-options.end.velocity);
          state.a =
              is_start ? options.start.acceleration : options.end.acceleration;
          bool is_hit = false;
          for (const auto& sample :
               internal::StopsFrom(state, options.limits, one.diagonal)[0]
                   .ToTrajectory()
                   .Samples(1e4)) {
            is_hit = is_hit || !one.space.IsFree(sample.position);
          }
          wrong += !is_hit;
          EXPECT_TRUE(is_hit) << text;
        }
        if (::testing::Test::HasFailure()) {
          FAIL() << family << " " << seed << " " << i;
        }
      }
    }
  }
  EXPECT_GE(certified, 4 * seeds * each);
  EXPECT_GE(refused, 1);
  testing::ReportCampaign({"5 exact motion checks",
                           "curves with ends in motion, certified or refused",
                           certified + refused, wrong, 0.0, 0.0, "", 3112});
}

TEST(OptimizeCurveEnds, SayTheDistanceOfAStopThatIsTooLong) {
  const testing::FreePath one = testing::PlanFreePath("plate0.1", 1);
  // Straight at the plate, from a place that is closer than a stop is long.
  const Vector3d start = one.path.front();
  Vector3d towards = one.path.back() - start;
  towards.normalize();
  const MotionCheck hit = one.space.Check(start, one.path.back());
  ASSERT_LT(hit.fraction, 1.0);
  const double gap = hit.fraction * (one.path.back() - start).norm();
  CurveOptions options = With(PlainLimits(true));
  options.limits.velocity.setConstant(10.0);
  options.limits.jerk.setConstant(1e4);
  // As fast as needs twice the gap: d = v (v/a + a/j)/2.
  const double speed = std::sqrt(4.0 * gap * kA);
  options.start.velocity = speed * towards;
  const std::string text = testing::ErrorOf(
      [&] { OptimizeCurve(one.space, one.diagonal, one.path, options); });
  const auto number_after = [&](const std::string& before) {
    return std::stod(text.substr(text.find(before) + before.size()));
  };
  EXPECT_NEAR(number_after("within the limits is "), 2.0 * gap, 0.02 * gap);
  EXPECT_NEAR(number_after("is free for "), gap, 0.01 * gap) << text;
}

void ExpectError(const CurveOptions& options, const std::string& part) {
  testing::ExpectRefused([&] { options.Validate(); }, part);
}

TEST(OptimizeCurveEnds, AreRefusedBeyondTheLimits) {
  CurveOptions options = With(PlainLimits());
  options.start.velocity = Vector3d(0.0, -1.1, 0.0);
  ExpectError(options, "start velocity of y: expected at most the limit, 1");
  options = With(PlainLimits(true));
  options.end.velocity = Vector3d(0.8, 0.8, 0.0);
  ExpectError(options, "end velocity: expected at most the limit, 1");
  options = With(PlainLimits());
  options.end.acceleration = Vector3d(0.0, 0.0, 2.1);
  ExpectError(options, "end acceleration of z");
  // Faster and faster, and no time left to stop that.
  options = With(PlainLimits());
  options.start = {Vector3d(0.95, 0, 0), Vector3d(1.5, 0, 0)};
  ExpectError(options, "start acceleration of x: expected one that can fade");
  options = With(PlainLimits());
  options.end = {Vector3d(0.95, 0, 0), Vector3d(1.5, 0, 0)};
  options.Validate();  // that is what it comes from
  options.end.acceleration *= -1.0;
  ExpectError(options, "end acceleration of x: expected one that can fade");
  options = With(PlainLimits());
  options.end.velocity[1] = std::numeric_limits<double>::quiet_NaN();
  ExpectError(options, "NaN");
}

}  // namespace
}  // namespace phongpd
