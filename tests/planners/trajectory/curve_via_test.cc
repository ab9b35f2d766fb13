// SPDX-License-Identifier: GPL-3.0-or-later
// Curves that pass places on their way.  Truth: distances of dense samples,
// closed forms, the judges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "planners/exact/contact_surface_planner.h"
#include "planners/trajectory/curve_optimizer.h"
#include "planners/trajectory/trajectory_problem.h"
#include "tests/support/campaign.h"
#include "tests/support/curve_problems.h"
#include "tests/support/expect_refused.h"
#include "tests/support/path_problems.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

CurveOptions ViaOptions(bool by_norm = false) {
  CurveOptions options;
  options.limits = testing::PlainLimits(by_norm);
  options.preset = Preset::kFast;
  return options;
}

CurveVia Via(const Vector3d& point, double tolerance, double dwell = 0.0) {
  CurveVia via;
  via.point = point;
  via.tolerance = tolerance;
  via.dwell = dwell;
  return via;
}

// Passes all places in order, as near as said, by samples: of a knot the time
// is one of them.  Rests there as long as said.
void ExpectPassed(const Trajectory& curve, const std::vector<CurveVia>& via) {
  std::vector<double> times;
  for (std::size_t i = 0; i < curve.pieces().size(); ++i) {
    for (int k = 0; k < 100; ++k) {
      times.push_back(curve.StartOf(i) +
                      0.01 * k * curve.pieces()[i].duration());
    }
  }
  times.push_back(curve.duration());
  std::size_t at = 0;
  for (std::size_t i = 0; i < via.size(); ++i) {
    const auto is_near = [&](double t) {
      return (curve.At(t).position - via[i].point).norm() <=
             via[i].tolerance * (1.0 + 1e-9);
    };
    while (at < times.size() && !is_near(times[at])) ++at;
    ASSERT_LT(at, times.size()) << "via " << i;
    double rest = 0.0;
    for (const CurvePiece& piece : curve.pieces()) {
      bool is_there = true;
      for (int j = 0; j <= piece.degree(); ++j) {
        is_there = is_there && piece.point(j) == via[i].point;
      }
      if (is_there) rest += piece.duration();
    }
    EXPECT_GE(rest, via[i].dwell * (1.0 - 1e-12));
  }
}

void ExpectCertifiedAndPassed(const FreeSpace& space, const Path& path,
                              const CurveOptions& options,
                              const CurveSummary& summary) {
  ASSERT_NO_FATAL_FAILURE(
      testing::ExpectCertified(space, path, options.limits, summary));
  ExpectPassed(summary.trajectory, options.via);
}

TEST(OptimizeCurveVia, PassesAPlaceFasterThanItStopsThere) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Path path = {{0, 0, 0}, {1, 0.3, 0}, {2, 0, 0}};
  CurveOptions options = ViaOptions();
  // Each axis alone: up to speed and down again, 0.7 s each, and what is left.
  const double straight = 2.0 + 0.7;
  double before = std::numeric_limits<double>::infinity();
  for (const double tolerance : {1e-4, 0.01, 0.1, 0.31}) {
    options.via = {Via(path[1], tolerance)};
    const CurveSummary summary = OptimizeCurve(space, 2.0, path, options);
    ExpectCertifiedAndPassed(space, path, options, summary);
    EXPECT_LT(summary.duration, 0.8 * summary.stops_duration);
    EXPECT_LE(summary.duration, 1.01 * before) << tolerance;
    EXPECT_GE(summary.duration, straight);
    before = summary.duration;
  }
  EXPECT_LT(before, 1.05 * straight);  // the ball reaches the straight line
  // Rests, and no other way than to stop there.
  options.via = {Via(path[1], 0.1, 1.5)};
  const CurveSummary rest = OptimizeCurve(space, 2.0, path, options);
  ExpectCertifiedAndPassed(space, path, options, rest);
  EXPECT_GT(rest.duration, 1.5 + 1.2 * before);
  EXPECT_NEAR(rest.cost, rest.duration, 1e-12);  // no margin, nothing missing
}

// There and back: the second place is not passed on the way to the first.
TEST(OptimizeCurveVia, KeepsTheOrder) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Path path = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  CurveOptions options = ViaOptions();
  options.via = {Via(path[1], 0.05), Via(path[2], 0.05)};
  const CurveSummary summary = OptimizeCurve(space, 3.0, path, options);
  ExpectCertifiedAndPassed(space, path, options, summary);
  EXPECT_GE(summary.duration, 1.95 + 0.9 + 1.95);
  // Also with ends in motion, and with places that are ends.
  options.start.velocity = options.end.velocity = Vector3d(0.9, 0.2, 0.0);
  ExpectCertifiedAndPassed(space, path, options,
                           OptimizeCurve(space, 3.0, path, options));
  options.via = {Via(path[0], 0.05), Via(path[1], 0.05), Via(path[3], 0.05)};
  ExpectCertifiedAndPassed(space, path, options,
                           OptimizeCurve(space, 3.0, path, options));
}

// At the start, twice at a place and at the goal: the ways between, and rests.
TEST(OptimizeCurveVia, RestsWhereThereIsNoWayBetween) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Path path = {{0, 0, 0}, {1, 0.3, 0}, {2, 0, 0}};
  CurveOptions options = ViaOptions();
  options.via = {Via(path[1], 0.1, 1.0)};
  const CurveSummary once = OptimizeCurve(space, 2.0, path, options);
  options.via = {Via(path[0], 0.1, 0.5), Via(path[1], 0.1, 0.25),
                 Via(path[1], 0.1, 0.75), Via(path[2], 0.1, 2.0)};
  const CurveSummary rests = OptimizeCurve(space, 2.0, path, options);
  ExpectCertifiedAndPassed(space, path, options, rests);
  EXPECT_NEAR(rests.duration, once.duration + 2.5, 1e-12);
  EXPECT_EQ(rests.trajectory.At(0.5).position, path[0]);
  EXPECT_EQ(rests.trajectory.At(rests.duration - 2.0).position, path[2]);
}

TEST(OptimizeCurveViaCampaign, PassesRandomPlacesInClutter) {
  std::mt19937_64 random(3121);
  const long each = testing::CampaignCases(3, 40);
  long cases = 0, wrong = 0;
  for (const std::string& family : testing::CurveFamilies()) {
    const testing::PathProblem problem = testing::MakePathProblem(family, 1);
    const ContactSpace contact = TakeAsContactSpace(problem.contact);
    const FreeSpace space({contact});
    const double diagonal = ComputeBounds(problem.contact).Diagonal();
    const ContactSurfacePlanner planner(contact);
    for (long i = 0; i < each; ++i) {
      CurveOptions options = ViaOptions(i % 3 == 0);
      Path path = {problem.start};
      const int places = 1 + static_cast<int>(i % 3);
      for (int k = 0; k <= places; ++k) {
        Vector3d next = problem.goal;
        while (k < places && (next == problem.goal || !space.IsFree(next))) {
          next = testing::RandomPoint(contact.bounds(), &random);
        }
        const PlanResult plan = planner.Plan(path.back(), next);
        if (plan.status != PathStatus::kSolved) continue;
        path.insert(path.end(), plan.path.begin() + 1, plan.path.end());
        if (k == places) break;
        const double tolerances[] = {1e-5, 0.01, 0.2};
        options.via.push_back(Via(next, tolerances[random() % 3] * diagonal,
                                  random() % 3 == 0 ? 0.5 : 0.0));
      }
      if (path.back() != problem.goal) continue;
      if (i % 4 == 3) options.margin = 0.005 * diagonal;
      const CurveSummary summary =
          OptimizeCurve(space, diagonal, path, options);
      ++cases;
      ExpectCertifiedAndPassed(space, path, options, summary);
      wrong += ::testing::Test::HasFailure();
      if (wrong > 0) FAIL() << family << " " << i;
    }
  }
  EXPECT_GE(cases, 6 * each);
  testing::ReportCampaign({"5 exact motion checks",
                           "curves through random places in clutter", cases,
                           wrong, 0.0, 0.0, "", 3121});
}

void ExpectViaError(const CurveOptions& options, const std::string& part) {
  const FreeSpace space{std::vector<ContactSpace>{}};
  const Path path = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  testing::ExpectRefused([&] { OptimizeCurve(space, 1.0, path, options); },
                         part);
}

TEST(OptimizeCurveVia, RefusesWhatIsNoPlaceOnTheWay) {
  CurveOptions options = ViaOptions();
  options.via = {Via({1, 0, 0}, 0.0)};
  ExpectViaError(options, "via 0: expected a tolerance above 0, found 0");
  options.via = {Via({1, 0, 0}, 0.1), Via({1, 1, 0}, 0.1)};
  ExpectViaError(options, "via 1: expected a point of the path, in order");
  options.via = {Via({2, 0, 0}, 0.1), Via({1, 0, 0}, 0.1)};
  ExpectViaError(options, "via 1: expected a point of the path, in order");
  options.via = {Via({1, 0, 0}, 0.1, -1.0)};
  ExpectViaError(options, "via 0: expected a dwell of 0 seconds or more");
  options.via = {Via({std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0.1)};
  ExpectViaError(options, "via 0: expected a finite point");
}

}  // namespace
}  // namespace phongpd
