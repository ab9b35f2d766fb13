// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"

namespace phongpd::testing {

// The metrics that campaigns hold against each other: Euclidean PD, then
// PhongPD without smoothing and with the length `ell` (of the diagonal).
inline std::vector<std::unique_ptr<PenetrationMetric>> EuclideanAndPhong(
    const TriangleMesh& mesh, double ell) {
  std::vector<std::unique_ptr<PenetrationMetric>> metrics;
  metrics.push_back(std::make_unique<EuclideanMetric>(mesh));
  for (const double length : {0.0, ell}) {
    PhongMetricOptions options;
    options.field_options.smoothing_length = length;
    metrics.push_back(std::make_unique<PhongMetric>(mesh, options));
  }
  return metrics;
}

}  // namespace phongpd::testing
