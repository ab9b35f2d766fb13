// SPDX-License-Identifier: GPL-3.0-or-later
// Queries allocate nothing and may run in threads: promises of
// penetration_metric.h, checked by counting every allocation of the process.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/penetration_tracker.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/count_allocations.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

Vector3d OnPath(int i) {
  const double t = 1e-3 * i;
  return {1.1 * std::cos(3.0 * t), 0.9 * std::sin(5.0 * t), 0.2 * std::sin(t)};
}

double Sum(const PenetrationMetric& metric, int first, int last) {
  double sum = 0.0;
  Branch branch;
  for (int i = first; i < last; ++i) {
    const PenetrationResult warm = metric.Query(OnPath(i), branch);
    branch = warm.branch;
    sum += warm.signed_distance + metric.Query(OnPath(i)).signed_distance;
  }
  return sum;
}

TEST(QueryCost, QueriesDoNotAllocate) {
  const TriangleMesh mesh = MakeTorus(1.0, 0.35, 40, 16);
  const PhongMetric phong = testing::UnsmoothedPhong(TakeAsContactSpace(mesh));
  const PhongMetric newton = testing::UnsmoothedPhong(TakeAsContactSpace(mesh),
                                                      FieldKind::kTangentPlane);
  const EuclideanMetric euclidean(TakeAsContactSpace(mesh));
  std::vector<PenetrationResult> all;
  all.reserve(4096);
  const long before = allocations;
  double sum = Sum(phong, 0, 2000) + Sum(euclidean, 0, 2000);
  EXPECT_EQ(allocations, before);
  sum += Sum(newton, 0, 500);
  EXPECT_EQ(allocations, before);
  for (int i = 0; i < 500; ++i) {
    phong.QueryAll(OnPath(i), 1.0, &all);
    sum += static_cast<double>(all.size());
  }
  EXPECT_EQ(allocations, before);
  EXPECT_NE(sum, 0.0);
}

TEST(QueryCost, OrdinaryStepsOfTheTrackerDoNotAllocate) {
  const PenetrationTracker tracker(
      TakeAsContactSpace(MakeTorus(1.0, 0.35, 60, 24)));
  PenetrationTracker::State state;
  const auto lap = [&] {
    int following = 0;
    for (int i = 0; i < 2000; ++i) {
      const double t = 0.00314159 * i;
      const TrackerResult now =
          tracker.Step({1.1 * std::cos(t), 1.1 * std::sin(t), 0.05}, &state);
      following += now.status == QueryStatus::kFollowing ? 1 : 0;
    }
    return following;
  };
  for (int i = 0; i < 20; ++i) tracker.Step({1.1, 0.001 * i, 0.05}, &state);
  const long before = allocations;
  EXPECT_EQ(lap(), 2000);
  EXPECT_EQ(allocations, before);
}

TEST(QueryCost, ThreadsGetTheSameBits) {
  const PhongMetric metric = testing::UnsmoothedPhong(
      TakeAsContactSpace(MakeTorus(1.0, 0.35, 40, 16)));
  const double alone = Sum(metric, 0, 3000);
  double sums[2] = {0.0, 0.0};
  std::thread first([&] { sums[0] = Sum(metric, 0, 3000); });
  std::thread second([&] { sums[1] = Sum(metric, 0, 3000); });
  first.join();
  second.join();
  EXPECT_EQ(sums[0], alone);
  EXPECT_EQ(sums[1], alone);
}

}  // namespace
}  // namespace phongpd
