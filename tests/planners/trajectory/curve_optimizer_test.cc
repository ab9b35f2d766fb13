// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of jerk-limited motions, power series of the pieces
// sampled densely, the exact judge of points, FCL.
#include "planners/trajectory/curve_optimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "constraints/curve_judge.h"
#include "constraints/oracle/collision_oracle.h"
#include "planners/exact/contact_surface_planner.h"
#include "problems/shapes/shapes.h"
#include "tests/support/curve_problems.h"
#include "tests/support/expect_refused.h"
#include "tests/support/passages.h"
#include "tests/support/path_problems.h"
#include "tests/support/rest_to_rest.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;
using testing::RestToRest;

MotionLimits Limits(double v, double a, double j) {
  MotionLimits limits;
  limits.velocity.setConstant(v);
  limits.acceleration.setConstant(a);
  limits.jerk.setConstant(j);
  return limits;
}

CurveOptions With(const MotionLimits& limits) {
  CurveOptions options;
  options.limits = limits;
  return options;
}

// Stopping at every corner, limits by axis, the same for all axes.
double StopTime(const Path& path, double v, double a, double j) {
  double time = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    time += RestToRest((path[i + 1] - path[i]).cwiseAbs().maxCoeff(), v, a, j);
  }
  return time;
}

// Each axis alone, nothing in the way.
double LowerBound(const Path& path, double v, double a, double j) {
  return RestToRest((path.back() - path.front()).cwiseAbs().maxCoeff(), v, a,
                    j);
}

// q and its derivatives of orders 1 to 3 by the power series of the piece.
std::array<Vector3d, 4> ByPowers(const CurvePiece& piece, double s) {
  constexpr double kBinomial[6][6] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0},
                                      {1, 2, 1, 0, 0, 0}, {1, 3, 3, 1, 0, 0},
                                      {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};
  std::array<Vector3d, 4> result;
  result.fill(Vector3d::Zero());
  for (int k = 0; k <= 5; ++k) {
    Vector3d c = Vector3d::Zero();  // of s^k, about the first point
    for (int i = 0; i <= k; ++i) {
      const double sign = (k - i) % 2 == 0 ? 1.0 : -1.0;
      c += sign * kBinomial[5][k] * kBinomial[k][i] *
           (piece.point(i) - piece.front());
    }
    double factor = 1.0;
    for (int order = 0; order <= std::min(k, 3); ++order) {
      result[order] += c * factor * std::pow(s, k - order) /
                       std::pow(piece.duration(), order);
      factor *= k - order;
    }
  }
  result[0] += piece.front();
  return result;
}

// What a certified answer promises, by dense samples.
void ExpectKept(const CurveSummary& summary, const MotionLimits& limits,
                const FreeSpace& space, const std::string& what,
                const CollisionOracle* oracle = nullptr) {
  const Trajectory& trajectory = summary.trajectory;
  ASSERT_FALSE(trajectory.empty()) << what;
  EXPECT_TRUE(CheckCurve(space, trajectory).IsFree()) << what;
  EXPECT_TRUE(BoundLimitUse(trajectory, limits).IsKept()) << what;
  EXPECT_EQ(summary.duration, trajectory.duration());
  const int samples = 10'000 / static_cast<int>(trajectory.pieces().size()) + 2;
  std::array<Vector3d, 4> before;
  before.fill(Vector3d::Zero());
  before[0] = trajectory.pieces().front().front();
  const std::array<Vector3d, 4> most = {Vector3d::Ones(), limits.velocity,
                                        limits.acceleration, limits.jerk};
  double worst = 0.0, gap = 0.0;
  int hits = 0;
  for (const CurvePiece& piece : trajectory.pieces()) {
    ASSERT_EQ(piece.degree(), 5);
    for (int i = 0; i < samples; ++i) {
      const auto x = ByPowers(piece, i / (samples - 1.0));
      for (int order = 1; order <= 3; ++order) {
        worst = std::max(
            worst,
            limits.by_norm
                ? x[order].norm() / most[order][0]
                : x[order].cwiseAbs().cwiseQuotient(most[order]).maxCoeff());
        if (i == 0 && order < 3) {
          gap = std::max(
              gap,
              (x[order] - before[order]).cwiseQuotient(most[order]).norm());
        }
      }
      if (i + 1 == samples) before = x;
      hits += !space.IsFree(piece.At(i / (samples - 1.0)));
      if (oracle != nullptr && i % 8 == 0) hits += oracle->Collides(x[0]);
    }
  }
  EXPECT_LE(worst, 1.0 + 1e-9) << what;
  EXPECT_LT(gap, 1e-7) << what << ": not C²";
  EXPECT_LT(before[1].norm(), 1e-9 * most[1].norm()) << what << ": no rest";
  EXPECT_LT(before[2].norm(), 1e-7 * most[2].norm()) << what << ": no rest";
  EXPECT_EQ(hits, 0) << what;
}

TEST(OptimizeCurve, MovesStraightAlmostAsFastAsCanBe) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  struct Limit {
    double v, a, j;
  };
  // Bound by velocity, by acceleration, by jerk, by all.
  for (const Limit& one : std::vector<Limit>{
           {0.2, 10, 500}, {100, 1, 200}, {100, 100, 1}, {1, 2, 10}}) {
    for (const Vector3d& goal : {Vector3d(1, 0, 0), Vector3d(1, -0.7, 0.2)}) {
      const Path path = {Vector3d::Zero(), goal};
      CurveOptions options = With(Limits(one.v, one.a, one.j));
      options.preset = Preset::kTight;
      const CurveSummary summary = OptimizeCurve(space, 1.0, path, options);
      const double least = LowerBound(path, one.v, one.a, one.j);
      EXPECT_GE(summary.duration, least * (1.0 - 1e-12));
      EXPECT_LE(summary.duration, 1.04 * least)
          << one.v << " " << one.a << " " << one.j;
      ExpectKept(summary, options.limits, space, "straight");
    }
  }
}

TEST(OptimizeCurve, IsFreeAndWithinLimitsAndFasterThanStops) {
  std::vector<double> ratios;
  for (const std::string& family : testing::CurveFamilies()) {
    for (int seed = 1; seed <= 3; ++seed) {
      const testing::FreePath one =
          testing::PlanFreePath(family, static_cast<std::uint64_t>(seed));
      const std::string what = family + " " + std::to_string(seed);
      const CurveOptions options = With(Limits(1.0, 2.0, 10.0));
      const CurveSummary summary =
          OptimizeCurve(one.space, one.diagonal, one.path, options);
      EXPECT_EQ(summary.status, PathStatus::kConverged) << what;
      ExpectKept(summary, options.limits, one.space, what);
      EXPECT_EQ(summary.trajectory.pieces().front().front(), one.path.front());
      EXPECT_EQ(summary.trajectory.pieces().back().back(), one.path.back());
      EXPECT_GE(summary.duration,
                LowerBound(one.path, 1.0, 2.0, 10.0) * (1.0 - 1e-12));
      double before = summary.stops_duration * (1.0 + 1e-9);
      for (const CurveRound& round : summary.rounds) {
        EXPECT_LE(round.duration, before) << what;
        before = round.duration * (1.0 + 1e-9);
      }
      EXPECT_LE(summary.duration, before) << what;
      const double ratio =
          StopTime(one.path, 1.0, 2.0, 10.0) / summary.duration;
      EXPECT_GT(ratio, 1.1) << what;
      ratios.push_back(ratio);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_GT(ratios[ratios.size() / 2], 1.25);
}

// Places to pass keep the segments of a path, each of three pieces at first.
TEST(OptimizeCurve, HalvesPiecesAsThePresetSays) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  struct Expected {
    int segments;
    std::array<int, 3> pieces;  // of fast, balanced, tight
  };
  for (const auto& [segments, pieces] :
       std::vector<Expected>{{1, {6, 24, 48}},
                             {2, {12, 48, 96}},
                             {6, {18, 72, 144}},
                             {7, {21, 42, 84}}}) {
    Path path = {Vector3d::Zero()};
    CurveOptions options = With(Limits(1.0, 2.0, 10.0));
    for (int i = 1; i <= segments; ++i) path.emplace_back(i, i % 2, 0.0);
    for (int i = 1; i < segments; ++i) {
      options.via.push_back({path[static_cast<std::size_t>(i)], 0.05, 0.0});
    }
    double before = std::numeric_limits<double>::infinity();
    for (const Preset preset :
         {Preset::kFast, Preset::kBalanced, Preset::kTight}) {
      options.preset = preset;
      const CurveSummary found = OptimizeCurve(space, 1.0, path, options);
      EXPECT_EQ(found.rounds.back().pieces,
                pieces[static_cast<std::size_t>(preset)])
          << segments;
      EXPECT_LT(found.duration, before) << segments;
      before = found.duration;
    }
  }
}

// A line that leaves an edge by less than what rounding takes a curve off it:
// free, but no way for a curve, where the path has room.
TEST(OptimizeCurve, KeepsOffEdgesThatALineAllButTouches) {
  const FreeSpace space({TakeAsContactSpace(
      MakeBox(Vector3d::Constant(-1.0), Vector3d::Constant(1.0)))});
  const double beside = 0x1p-51;
  for (const double far : {3.0, 2.0, 1.5}) {
    const Vector3d a(far + beside, 2.0 - far, 0.0);
    const Vector3d b(2.0 - far, far + beside, 0.0);
    ASSERT_TRUE(space.IsFree(a, b));
    ASSERT_LT(space.Clearance(a, b), 1e-15);
    const Path path = {a, Vector3d(far, far, 0.0), b};
    for (const double margin : {0.0, 1e-3}) {
      CurveOptions options = With(Limits(1.0, 2.0, 10.0));
      options.margin = margin;
      const CurveSummary summary = OptimizeCurve(space, 4.0, path, options);
      EXPECT_EQ(summary.status, PathStatus::kConverged) << far;
      ExpectKept(summary, options.limits, space, std::to_string(far));
    }
  }
}

TEST(OptimizeCurve, PassesTunnels) {
  for (const double delta : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const testing::Passage passage = testing::MakePassage("tunnel", delta, 1);
    const FreeSpace& space = passage.model->free_space();
    const PlanResult plan = ContactSurfacePlanner(passage.model->space(0))
                                .Plan(passage.scene.start, passage.scene.goal);
    ASSERT_EQ(plan.status, PathStatus::kSolved);
    const CollisionOracle oracle(passage.scene.workspace.robot,
                                 MergedObstacle(passage.scene.workspace));
    CurveOptions options = With(Limits(1.0, 2.0, 10.0));
    options.preset = Preset::kFast;
    const CurveSummary summary =
        OptimizeCurve(space, passage.model->diagonal(), plan.path, options);
    const std::string what = "delta " + std::to_string(delta);
    ExpectKept(summary, options.limits, space, what, &oracle);
    EXPECT_LT(summary.duration, summary.stops_duration) << what;
    EXPECT_LE(summary.clearance, delta) << what;
    EXPECT_GT(summary.clearance, 0.0) << what;
  }
}

TEST(OptimizeCurve, KeepsLimitsOfNorms) {
  for (const std::string family : {"Uaxis", "hole", "clutter"}) {
    const testing::FreePath one = testing::PlanFreePath(family, 1);
    CurveOptions options = With(Limits(1.0, 2.0, 10.0));
    const double by_axis =
        OptimizeCurve(one.space, one.diagonal, one.path, options).duration;
    options.limits.by_norm = true;
    const CurveSummary summary =
        OptimizeCurve(one.space, one.diagonal, one.path, options);
    ExpectKept(summary, options.limits, one.space, family);
    EXPECT_GT(summary.duration, by_axis) << family;
    EXPECT_LT(summary.duration, std::sqrt(3.0) * by_axis) << family;
    EXPECT_LT(summary.duration, 0.75 * summary.stops_duration) << family;
  }
}

TEST(OptimizeCurve, DoesNotDependOnUnits) {
  const testing::PathProblem problem = testing::MakePathProblem("hole", 2);
  const testing::FreePath one = testing::PlanFreePath("hole", 2);
  CurveOptions options = With(Limits(1.0, 2.0, 10.0));
  const double duration =
      OptimizeCurve(one.space, one.diagonal, one.path, options).duration;
  const double unit = 1000.0, time = 60.0;  // millimetres, minutes
  TriangleMesh contact = problem.contact;
  for (Vector3d& q : contact.vertices) q *= unit;
  Path path = one.path;
  for (Vector3d& q : path) q *= unit;
  options.limits = Limits(unit * time, 2.0 * unit * time * time,
                          10.0 * unit * time * time * time);
  const CurveSummary other =
      OptimizeCurve(FreeSpace({TakeAsContactSpace(contact)}),
                    one.diagonal * unit, path, options);
  EXPECT_NEAR(other.duration * time, duration, 1e-3 * duration);
}

TEST(OptimizeCurve, KeepsTheMarginWhereThereIsRoom) {
  for (const std::string family : {"plate0.1", "torus", "L", "clutter"}) {
    const testing::FreePath one = testing::PlanFreePath(family, 1);
    CurveOptions options = With(Limits(1.0, 2.0, 10.0));
    const CurveSummary free =
        OptimizeCurve(one.space, one.diagonal, one.path, options);
    options.margin = 0.01 * one.diagonal;
    for (const auto& [price, kept] :
         {std::pair(50.0, 0.9), std::pair(200.0, 0.9999)}) {
      options.margin_price = price;
      const CurveSummary summary =
          OptimizeCurve(one.space, one.diagonal, one.path, options);
      ExpectKept(summary, options.limits, one.space, family);
      EXPECT_GE(summary.margin, kept * options.margin) << family << price;
      EXPECT_LE(summary.margin, options.margin) << family;
      EXPECT_LT(summary.duration, 1.2 * free.duration) << family;
      // By distances of points.
      double least = std::numeric_limits<double>::infinity();
      for (const auto& sample : summary.trajectory.Samples(200.0)) {
        least = std::min(least, one.space.Clearance(sample.position));
      }
      EXPECT_GE(least, summary.clearance * (1.0 - 1e-9)) << family;
    }
  }
}

// At the price at which it is kept, and so wide that the first curve lacks much
// of it: the curve becomes fast nevertheless.
TEST(OptimizeCurve, BecomesFastWithAWideMargin) {
  for (const std::string& family : testing::CurveFamilies()) {
    for (int seed = 1; seed <= 3; ++seed) {
      const testing::FreePath one =
          testing::PlanFreePath(family, static_cast<std::uint64_t>(seed));
      CurveOptions options = With(Limits(1.0, 2.0, 10.0));
      const CurveSummary free =
          OptimizeCurve(one.space, one.diagonal, one.path, options);
      options.margin = 0.03 * one.diagonal;
      options.margin_price = 200.0;
      const CurveSummary summary =
          OptimizeCurve(one.space, one.diagonal, one.path, options);
      const std::string what = family + " " + std::to_string(seed);
      ExpectKept(summary, options.limits, one.space, what);
      EXPECT_LT(summary.duration, 1.35 * free.duration) << what;
    }
  }
}

TEST(OptimizeCurve, AlwaysHasACertifiedAnswer) {
  const testing::FreePath one = testing::PlanFreePath("clutter", 2);
  CurveOptions options = With(Limits(1.0, 2.0, 10.0));
  options.time_limit = 1e-9;
  const CurveSummary first =
      OptimizeCurve(one.space, one.diagonal, one.path, options);
  EXPECT_EQ(first.status, PathStatus::kTimeLimit);
  ExpectKept(first, options.limits, one.space, "time limit");
  EXPECT_TRUE(first.rounds.empty());

  options.time_limit = std::numeric_limits<double>::infinity();
  int asked = 0;
  options.is_interrupted = [&] { return ++asked > 3; };
  const CurveSummary some =
      OptimizeCurve(one.space, one.diagonal, one.path, options);
  EXPECT_EQ(some.status, PathStatus::kInterrupted);
  EXPECT_EQ(some.rounds.size(), 3u);
  ExpectKept(some, options.limits, one.space, "interrupted");
  EXPECT_LT(some.duration, first.duration);
}

TEST(OptimizeCurve, SaysThatThePathIsNotFree) {
  const testing::FreePath one = testing::PlanFreePath("plate0.1", 1);
  const CurveSummary summary =
      OptimizeCurve(one.space, one.diagonal,
                    {one.path.front(), one.path.back()}, With(Limits(1, 1, 1)));
  EXPECT_EQ(summary.status, PathStatus::kNotFree);
  EXPECT_TRUE(summary.trajectory.empty());
}

void ExpectError(const CurveOptions& options, const Path& path,
                 const std::string& part, double diagonal = 1.0) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  testing::ExpectRefused([&] { OptimizeCurve(space, diagonal, path, options); },
                         part);
}

TEST(OptimizeCurve, RefusesBadInputInOneLine) {
  const Path path = {Vector3d::Zero(), Vector3d::Ones()};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    CurveOptions options = With(Limits(1.0, 2.0, 10.0));
    options.limits.velocity[1] = bad;
    ExpectError(options, path, "velocity of y");
    options = With(Limits(1.0, 2.0, 10.0));
    options.limits.jerk[2] = bad;
    ExpectError(options, path, "jerk of z");
  }
  CurveOptions options;
  ExpectError(options, path, "of x, found none");
  options.limits.velocity = {1.0, 1.0, MotionLimits::kNone};
  ExpectError(options, path, "of z, found none");
  options = With(Limits(1.0, 2.0, 10.0));
  ExpectError(options, {}, "found none");
  ExpectError(options, {path[0], path[0]}, "found one");
  ExpectError(options, {path[0], Vector3d(nan, 0, 0)}, "NaN");
  ExpectError(options, path, "diagonal", 0.0);
  options.margin = -1.0;
  ExpectError(options, path, "margin");
  options = With(Limits(1.0, 2.0, 10.0));
  options.time_limit = 0.0;
  ExpectError(options, path, "time_limit");
}

}  // namespace
}  // namespace phongpd
