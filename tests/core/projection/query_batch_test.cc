// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: one query a point, with one thread.
#include "core/projection/query_batch.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstring>
#include <limits>
#include <random>

#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"
#include "problems/shapes/shapes.h"
#include "tests/support/metrics.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

bool AreSame(const PenetrationResult& a, const PenetrationResult& b) {
  return a.status == b.status && a.inside == b.inside &&
         a.signed_distance == b.signed_distance && a.contact == b.contact &&
         a.direction == b.direction && a.gradient == b.gradient &&
         a.triangle == b.triangle && a.branch.triangle == b.branch.triangle &&
         a.branch.lambda == b.branch.lambda && a.branch.s == b.branch.s;
}

TEST(QueryBatch, AnswersEachPointAloneWhateverTheNumberOfThreads) {
  const ContactSpace space =
      BuildContactSpace(MakeIcoBall(0.3, 1), MakeU(2.0, 0.25, 0.5));
  PhongMetricOptions smooth;
  smooth.field_options.smoothing_length = 0.2;
  const PhongMetric phong = testing::UnsmoothedPhong(space);
  const PhongMetric smoothed(space, smooth);
  const EuclideanMetric euclidean(space);
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(-0.1, 1.1);
  std::vector<Vector3d> points;
  for (int i = 0; i < 1000; ++i) {
    const double x = uniform(engine), y = uniform(engine), z = uniform(engine);
    const BoundingBox& box = space.bounds();
    points.push_back(box.min +
                     Vector3d(x, y, z).cwiseProduct(box.max - box.min));
  }
  points[17].x() = std::numeric_limits<double>::quiet_NaN();
  const PenetrationMetric* metrics[] = {&phong, &smoothed, &euclidean};
  for (const PenetrationMetric* metric : metrics) {
    for (const std::size_t threads : {1, 2, 5}) {
      const tbb::global_control limit(
          tbb::global_control::max_allowed_parallelism, threads);
      const std::vector<PenetrationResult> results =
          QueryBatch(*metric, points);
      ASSERT_EQ(results.size(), points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_TRUE(AreSame(results[i], metric->Query(points[i]))) << i;
      }
    }
  }
  EXPECT_EQ(QueryBatch(phong, points)[17].status, QueryStatus::kInvalid);
}

TEST(QueryBatch, OfNoPointsIsEmpty) {
  const EuclideanMetric metric(BuildContactSpace(
      MakeBox({0, 0, 0}, {1, 1, 1}), MakeBox({0, 0, 0}, {2, 1, 1})));
  EXPECT_TRUE(QueryBatch(metric, {}).empty());
}

}  // namespace
}  // namespace phongpd
