// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/comparison_run.h"

#include <nlohmann/json.hpp>

#include "problems/output/answer_row.h"
#include "problems/scenes/scene_requests.h"

namespace phongpd {

OptimizeRequest RequestOf(const Scene& scene, const ComparisonRun& run) {
  OptimizeRequest request = OptimizeRequestOf(scene);
  request.limits.reset();
  request.model = Model::kFull;
  request.penetration = run.metric.penetration;
  request.own_metric = run.metric.own;
  request.verifies = false;
  // The scene's own Ipopt settings hold for every protocol.
  const auto ipopt_options = request.options.optimizer.ipopt.ipopt_options;
  request.options = run.protocol.options;
  request.options.optimizer.ipopt.ipopt_options = ipopt_options;
  request.options.seed = run.seed;
  const bool is_straight = request.options.start == TrajectoryStart::kStraight;
  if (!run.is_family && is_straight) request.options.start_noise = 0.01;
  return request;
}

nlohmann::ordered_json RunComparison(const Scene& scene, const World& world,
                                     const ComparisonRun& run) {
  const OptimizeRequest request = RequestOf(scene, run);
  nlohmann::ordered_json row =
      PolylineRow(scene, world, request, Optimize(world, request));
  row["protocol"] = run.protocol.name;
  return row;
}

}  // namespace phongpd
