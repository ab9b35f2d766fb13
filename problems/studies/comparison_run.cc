// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/comparison_run.h"

#include <nlohmann/json.hpp>

#include "problems/studies/clearance_wish.h"

namespace phongpd {

Scene SceneToCompare(Scene scene) {
  scene.trajectory.model = "full";
  return scene;
}

nlohmann::ordered_json RunComparison(const ComparisonRun& run,
                                     TrajectoryStudy* study) {
  PipelineOptions options = run.protocol.options;
  options.seed = run.seed;
  // The scene's own Ipopt settings hold for every protocol.
  options.optimizer.ipopt.ipopt_options =
      ScenePipelineOptions(study->scene()).optimizer.ipopt.ipopt_options;
  const bool is_straight = options.start == TrajectoryStart::kStraight;
  if (!run.is_family && is_straight) options.start_noise = 0.01;
  nlohmann::ordered_json row = TrajectoryRow(*study, run.metric, options,
                                             study->Run(run.metric, options));
  TellClearance(study->world(), study->scene(),
                WishOfTrajectory(study->scene(), false, false), &row);
  row["protocol"] = run.protocol.name;
  return row;
}

}  // namespace phongpd
