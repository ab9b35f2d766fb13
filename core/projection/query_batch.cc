// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/query_batch.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace phongpd {
namespace {

// Some 10 µs to 10 ms of work: enough to pay for a task, little enough to
// share evenly.
constexpr std::size_t kPointsPerTask = 64;

}  // namespace

void QueryBatch(const PenetrationMetric& metric, const Eigen::Vector3d* points,
                std::size_t count, PenetrationResult* results) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPointsPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end();
                           ++i) {
                        results[i] = metric.Query(points[i]);
                      }
                    });
}

std::vector<PenetrationResult> QueryBatch(
    const PenetrationMetric& metric,
    const std::vector<Eigen::Vector3d>& points) {
  std::vector<PenetrationResult> results(points.size());
  QueryBatch(metric, points.data(), points.size(), results.data());
  return results;
}

}  // namespace phongpd
