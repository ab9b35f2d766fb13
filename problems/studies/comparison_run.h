// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>

#include "problems/studies/trajectory_comparison.h"
#include "problems/studies/trajectory_study.h"

namespace phongpd {

// What gives one row of a comparison in the study's current scene.
struct ComparisonRun {
  std::uint64_t seed = 1;
  TrajectoryProtocol protocol;
  TrajectoryMetric metric;
  // A scene file differs from seed to seed by the start of the solver only, a
  // family of scenes by itself.
  bool is_family = false;
};

// The scene as comparisons enter it: of model full, because metrics are what is
// compared, and free space alone follows none.
Scene SceneToCompare(Scene scene);

// TrajectoryRow with what TellClearance says and the key `protocol`, wherever
// it is run: by phongpd compare, or by a worker of phongpd.cluster.  Throws
// what TrajectoryStudy::Run throws.
nlohmann::ordered_json RunComparison(const ComparisonRun& run,
                                     TrajectoryStudy* study);

}  // namespace phongpd
