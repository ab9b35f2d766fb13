// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/study_metrics.h"
#include "problems/studies/trajectory_comparison.h"

namespace phongpd {

// What gives one row of a comparison on a scene.
struct ComparisonRun {
  std::uint64_t seed = 1;
  TrajectoryProtocol protocol;
  StudyMetric metric;
  // A scene file differs from seed to seed by the start of the solver only, a
  // family of scenes by itself.
  bool is_family = false;
};

// What is asked of Optimize: a polyline in the whole model, because metrics are
// what is compared, and free space alone follows none.
OptimizeRequest RequestOf(const Scene& scene, const ComparisonRun& run);

// PolylineRow with the key `protocol`, wherever it is run: by phongpd compare,
// or by a worker of phongpd.cluster.  `world` is the scene's.  Throws what
// Optimize throws.
nlohmann::ordered_json RunComparison(const Scene& scene, const World& world,
                                     const ComparisonRun& run);

}  // namespace phongpd
