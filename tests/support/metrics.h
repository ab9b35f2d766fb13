// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/projection/euclidean_metric.h"
#include "core/projection/phong_metric.h"

namespace phongpd::testing {

// PhongPD of the paper's field, ℓ = 0, by either engine.
inline PhongMetric UnsmoothedPhong(const ContactSpace& space,
                                   FieldKind field = FieldKind::kNormal) {
  PhongMetricOptions options;
  options.field = field;
  options.field_options.smoothing_length = 0.0;
  return PhongMetric(space, options);
}

// The metrics that campaigns hold against each other: Euclidean PD, then
// PhongPD without smoothing and with the length `ell` (a share of D).
inline std::vector<std::unique_ptr<PenetrationMetric>> EuclideanAndPhong(
    const ContactSpace& space, double ell) {
  std::vector<std::unique_ptr<PenetrationMetric>> metrics;
  metrics.push_back(std::make_unique<EuclideanMetric>(space));
  for (const double length : {0.0, ell}) {
    PhongMetricOptions options;
    options.field_options.smoothing_length = length;
    metrics.push_back(std::make_unique<PhongMetric>(space, options));
  }
  return metrics;
}

}  // namespace phongpd::testing
