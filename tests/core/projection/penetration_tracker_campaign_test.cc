// SPDX-License-Identifier: GPL-3.0-or-later
// The bounds of penetration_tracker.h along 10⁵ frames, in the long form 10⁶:
// depth and place of the contact are judged by EuclideanMetric and by all
// triangles one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "core/bvh/closest_on_triangle.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "tests/support/campaign.h"
#include "tests/support/tracked_motions.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Motion;
using Space = testing::TrackedSpace;
using State = PenetrationTracker::State;

double DistanceByAllTriangles(const TriangleMesh& mesh, const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    least = std::min(least,
                     ClosestOnTriangle(mesh.vertices[t[0]], mesh.vertices[t[1]],
                                       mesh.vertices[t[2]], x)
                         .squared_distance);
  }
  return std::sqrt(least);
}

struct Figures {
  long frames = 0, inside = 0, above = 0, left_elsewhere = 0, sliding = 0;
  double ratios = 0.0;
  long failures = 0;   // of the bounds, or off the surface
  double worst = 0.0;  // |ΔPD| over its bound

  double MeanRatio() const { return ratios / static_cast<double>(inside); }
  double Above() const {
    return static_cast<double>(above) / static_cast<double>(inside);
  }
};

// Steps along the motion and holds every answer against the promises.
void Follow(const Space& space, const PenetrationTracker& tracker,
            const Motion& motion, Figures* figures) {
  const EuclideanMetric euclidean(space.contact);
  const double rounding = 1e-12 * space.contact.length();
  const double speed = tracker.options().speed;
  State state;
  TrackerResult before;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const TrackerResult now = tracker.Step(motion[i], &state);
    const double step = i == 0 ? 0.0 : (motion[i] - motion[i - 1]).norm();
    const PenetrationResult truth = euclidean.Query(motion[i]);
    bool ok = now.inside == truth.inside;
    ++figures->frames;
    if (now.inside) {
      ++figures->inside;
      ok = ok &&
           std::abs(now.euclidean_depth + truth.signed_distance) <= rounding;
      ok = ok && now.magnitude >= now.euclidean_depth - rounding;
      ok = ok && (now.contact - motion[i] - now.pd).norm() <= rounding;
      ok = ok && now.moved <= speed * step + rounding;
      const bool sample = figures->frames % 16 == 0;
      ok = ok && (!sample || DistanceByAllTriangles(space.contact.mesh(),
                                                    now.contact) <= rounding);
      if (before.inside) {
        ok =
            ok && (now.contact - before.contact).norm() <= now.moved + rounding;
      }
      figures->ratios += now.ratio;
      figures->above += now.ratio > 3.0 * (1.0 + 1e-9) ? 1 : 0;
      figures->sliding += now.status == QueryStatus::kSliding ? 1 : 0;
    } else {
      ok = ok && now.pd == Vector3d::Zero() && now.magnitude == 0.0;
    }
    const bool left = now.status == QueryStatus::kLeftElsewhere;
    figures->left_elsewhere += left ? 1 : 0;
    if (i > 0) {
      const double change = (now.pd - before.pd).norm();
      const double bound = (speed + 1.0) * step + rounding;
      if (!left) figures->worst = std::max(figures->worst, change / bound);
      // An exit is said to be elsewhere where it has to be, and only there.
      ok = ok &&
           (left ? !now.inside && before.inside && change > bound - 2 * rounding
                 : change <= bound);
    }
    if (!ok) {
      ++figures->failures;
      ADD_FAILURE() << space.name << ", frame " << i << ": "
                    << ToString(now.status) << ", |PD| " << now.magnitude
                    << ", d " << now.euclidean_depth << ", moved " << now.moved
                    << ", step " << step;
    }
    before = now;
  }
}

// Failing once in a thousand would be failing: 10⁵ frames in the suite, 10⁶ on
// 20 spaces in the long form.
TEST(PenetrationTrackerCampaign, DepthNeverChangesFasterThanItsBound) {
  const std::size_t count = testing::IsLongCampaign() ? 20 : 10;
  const long frames = testing::CampaignCases(100000, 1000000);
  testing::CampaignRow row;
  row.item = "tracker";
  row.subject = std::to_string(count) + " spaces, |dPD| over its bound";
  row.bound = 1.0;
  row.seed = 5;
  for (const Space& space : testing::TrackedSpaces(count)) {
    const PenetrationTracker tracker(space.contact);
    std::mt19937_64 random(row.seed);
    Figures all, smooth;
    const int length = 250;
    const int motions =
        static_cast<int>(frames / static_cast<long>(count) / length);
    for (int m = 0; m < motions; ++m) {
      const int kind = m % 3;
      Figures& figures = kind < 2 ? smooth : all;
      Follow(space, tracker,
             testing::MakeMotion(space.contact, kind, length, &random),
             &figures);
    }
    if (testing::IsLongCampaign())
      std::printf(
          "%-36s mean ratio %.3f, above 3: %.2f %%, elsewhere %ld, worst %.3f; "
          "walks: %.3f, %.2f %%, %ld, %.3f\n",
          space.name.c_str(), smooth.MeanRatio(), 100.0 * smooth.Above(),
          smooth.left_elsewhere, smooth.worst, all.MeanRatio(),
          100.0 * all.Above(), all.left_elsewhere, all.worst);
    row.cases += smooth.frames + all.frames;
    row.failures += smooth.failures + all.failures;
    row.worst = std::max({row.worst, smooth.worst, all.worst});
    EXPECT_LE(smooth.worst, 1.0) << space.name;
    if (space.is_hard) continue;
    EXPECT_LE(smooth.MeanRatio(), 1.1) << space.name;
    EXPECT_LE(smooth.Above(), 0.01) << space.name;
  }
  EXPECT_EQ(row.failures, 0);
  testing::ReportCampaign(row);
}

}  // namespace
}  // namespace phongpd
