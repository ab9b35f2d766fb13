// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/projection/query_batch.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace phongpd {
namespace {

// Some 10 µs to 10 ms of work: enough to pay for a task, little enough to
// share evenly.
constexpr std::size_t kPointsPerTask = 64;

template <typename Work>
void ForAll(std::size_t count, const Work& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kPointsPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end();
                           ++i) {
                        work(i);
                      }
                    });
}

}  // namespace

void QueryBatch(const PenetrationMetric& metric, const Eigen::Vector3d* points,
                std::size_t count, PenetrationResult* results) {
  ForAll(count, [&](std::size_t i) { results[i] = metric.Query(points[i]); });
}

void QueryBatch(
    const PenetrationMetric& metric, std::size_t count,
    const std::function<Eigen::Vector3d(std::size_t)>& point,
    const std::function<void(std::size_t, const PenetrationResult&)>& keep) {
  ForAll(count, [&](std::size_t i) { keep(i, metric.Query(point(i))); });
}

std::vector<PenetrationResult> QueryBatch(
    const PenetrationMetric& metric,
    const std::vector<Eigen::Vector3d>& points) {
  std::vector<PenetrationResult> results(points.size());
  QueryBatch(metric, points.data(), points.size(), results.data());
  return results;
}

}  // namespace phongpd
