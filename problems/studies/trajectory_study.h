// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "constraints/signed_metric.h"
#include "planners/trajectory/trajectory_pipeline.h"
#include "problems/scenes/scene.h"
#include "problems/world/scene_space.h"

namespace phongpd {

// The metric of a non-penetration row as users write it: "euclidean",
// "phong@L" with the smoothing length L (a fraction of D), "phong@L/exact" with
// the exact Jacobian, "phong@L/tangent-plane" with the paper's field.
struct TrajectoryMetric {
  std::string name = "phong@0.2";
  SignedMetricOptions options;  // smoothing length as a fraction of D
};

// Throws InputError starting with `what`.
TrajectoryMetric ParseTrajectoryMetric(const std::string& text,
                                       const std::string& what);
// The metric a scene asks for.
TrajectoryMetric SceneMetric(const Scene& scene);

// Runs the trajectory pipeline on one scene after the other.  Contact spaces,
// fields and repair graphs are kept while only start, goal and settings
// change, as they do from seed to seed of a family.
class TrajectoryStudy {
 public:
  explicit TrajectoryStudy(const ContactSpaceCache& cache = {},
                           SpaceLayout layout = SpaceLayout::kMerged)
      : cache_(cache), layout_(layout) {}

  // Makes `scene` the current one.  Throws InputError.
  void Enter(const Scene& scene);
  const Scene& scene() const { return scene_; }
  const SceneSpace& space() const { return space_; }

  // Options other than those the scene sets (waypoints, margin, ...).  The
  // reason of a start or goal in collision names the obstacle and the depth.
  PipelineResult Run(const TrajectoryMetric& metric,
                     const PipelineOptions& options);

  // The problem of the current scene; its metrics are shared between calls.
  TrajectoryProblem Problem(const TrajectoryMetric& metric);

 private:
  ContactSpaceCache cache_;
  SpaceLayout layout_;
  Scene scene_;
  SceneSpace space_;
  std::map<std::string, TrajectoryProblem> problems_;  // by metric
  std::shared_ptr<const StartRepair> repair_;
};

// The scene's Ipopt settings: the pipeline's defaults and the scene's own.
PipelineOptions ScenePipelineOptions(const Scene& scene);

// One row of results: everything but the scene's solids.  Keys as the command
// line documents them.
nlohmann::ordered_json TrajectoryRow(const TrajectoryStudy& study,
                                     const TrajectoryMetric& metric,
                                     const PipelineOptions& options,
                                     const PipelineResult& result);

// "straight", "repaired" (or "planner", the same) and "commit", "stateless",
// "outer-restart".  Throw InputError starting with the flag's name.
TrajectoryStart ParseStart(const std::string& text);
BranchPolicy ParsePolicy(const std::string& text);
const char* ToString(TrajectoryStart start);
const char* ToString(BranchPolicy policy);

}  // namespace phongpd
