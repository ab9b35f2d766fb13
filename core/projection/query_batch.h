// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/projection/penetration_metric.h"

namespace phongpd {

// metric.Query of every point, cold, on all threads that TBB has:
//
//   results[i] = metric.Query(points[i])      to the byte, whatever the number
//                                             of threads
//
// For many points that have nothing to do with each other: samplers, fields on
// a grid, plots.  Points along a motion are faster one after the other with
// the branch of the last (Query), and only then continue one branch.  Points
// that are not finite are kInvalid.  `points` and `results` hold `count`
// elements; nothing is allocated.
void QueryBatch(const PenetrationMetric& metric, const Eigen::Vector3d* points,
                std::size_t count, PenetrationResult* results);

// The same for callers with their own layout of data: reads point(i) and hands
// the result to keep(i, result), once for each i < count, on any thread and on
// several at a time.
void QueryBatch(
    const PenetrationMetric& metric, std::size_t count,
    const std::function<Eigen::Vector3d(std::size_t)>& point,
    const std::function<void(std::size_t, const PenetrationResult&)>& keep);

// The same, allocating its answer.
std::vector<PenetrationResult> QueryBatch(
    const PenetrationMetric& metric,
    const std::vector<Eigen::Vector3d>& points);

}  // namespace phongpd
