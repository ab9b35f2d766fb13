// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/signed_metric.h"
#include "planners/trajectory/trajectory_pipeline.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/model_choice.h"

namespace phongpd {

// The metric of a non-penetration row as users write it: "euclidean",
// "phong@L" with the smoothing length L (length.h), "phong@L/exact" with the
// exact Jacobian, "phong@L/tangent-plane" with the paper's field.
struct TrajectoryMetric {
  // phong only
  Length smoothing_length = Length::FromShare(kDefaultSmoothingLength);
  std::string name = "phong@" + smoothing_length.Text();
  SignedMetricOptions options;  // all else
  // A metric of a study's own in place of options.metric, ℓ in `options`
  // resolved; empty: none.
  std::function<std::shared_ptr<const PenetrationMetric>(
      const ContactSpace& space, const PhongMetricOptions& options)>
      make;
  std::string kind;  // what rows call it then
};

// Throws InputError starting with `what`.
TrajectoryMetric ParseTrajectoryMetric(const std::string& text,
                                       const std::string& what);
// The metric a scene asks for.
TrajectoryMetric SceneMetric(const Scene& scene);

// Runs the trajectory pipeline on one scene after the other.  Contact spaces,
// fields and repair graphs are kept while only start, goal and settings
// change, as they do from seed to seed of a family.
//
// What it builds is the scene's trajectory.model (model_choice.h).  In free
// space alone no metric is followed: OptimizeInFreeSpace (window_trajectory.h).
class TrajectoryStudy {
 public:
  explicit TrajectoryStudy(const ContactSpaceCache& cache = {},
                           SpaceLayout layout = SpaceLayout::kMerged,
                           const WorldLimits& limits = {})
      : cache_(cache), layout_(layout), limits_(limits) {}

  // Makes `scene` the current one; builds nothing.  Throws InputError.
  void Enter(const Scene& scene);
  // The same in a world that others share.  Throws InputError unless its solids
  // are the scene's.
  void Enter(const Scene& scene, const World& world);
  const Scene& scene() const { return scene_; }
  // Of the current scene; Enter comes first.
  const World& world() const { return *world_; }
  // Those it optimises in; builds them.
  const WorldSpaces& spaces() const { return world().Spaces(layout_); }
  // Their triangles; 0: they are not built.
  std::size_t triangles() const;
  // What the last run optimised in: "full", "window"; "none": it built nothing.
  const std::string& model() const { return used_model_; }
  // Why model auto took the window; empty: it did not.
  const std::string& refusal() const { return choice_.refusal(); }
  // The exact judge of the last run's path; of `model`.
  const FreeSpace& judge() const;

  // Options other than those the scene sets (waypoints, margin, ...).  A start
  // or goal in collision is said before anything is built, with the obstacle
  // and a bound of the depth.  Throws InputError; BuildRefusal where a limit
  // refuses what model full needs.
  PipelineResult Run(const TrajectoryMetric& metric,
                     const PipelineOptions& options);

  // The planes around a path of the last run as its corridor had them; empty
  // if it collides.  Throws like PlanesAround.
  std::vector<CorridorPlane> Corridor(const Path& path) const;

  // Where a path is looked for in free space alone: the bounds, or
  // SamplingRegion; models that.
  BoundingBox Region() const;

  // Of a path in the current scene (trajectory_problem.h).
  double Energy(const Path& path) const { return PathEnergy(Settings(), path); }

  // The problem of the current scene; its metrics are shared between calls.
  TrajectoryProblem Problem(const TrajectoryMetric& metric);

  // The metric's smoothing length in the current world; none for Euclid.
  std::optional<ResolvedLength> SmoothingLength(
      const TrajectoryMetric& metric) const;

 private:
  // All but the metrics and their judge.
  TrajectoryProblem Settings() const;
  SignedMetricOptions WorldOptions(const TrajectoryMetric& metric) const;
  bool Diagnose(PipelineResult* result) const;
  bool UsesWindow(TrajectoryStart start);
  PipelineResult RunInWindow(const PipelineOptions& options);
  PipelineResult RunInFull(const TrajectoryMetric& metric,
                           const PipelineOptions& options);

  ContactSpaceCache cache_;
  SpaceLayout layout_;
  WorldLimits limits_;
  ModelChoice choice_;
  std::string used_model_ = "none";
  Scene scene_;
  std::optional<World> world_;
  std::map<std::string, TrajectoryProblem> problems_;  // by metric
  std::shared_ptr<const StartRepair> repair_;
};

// What the preset sets in options that are as they come (planners/world/
// preset.h).
void ApplyPreset(Preset preset, PipelineOptions* options);

// The scene's preset and its Ipopt settings.
PipelineOptions ScenePipelineOptions(const Scene& scene);

// One row of results: everything but the scene's solids.  Keys as the command
// line documents them.
nlohmann::ordered_json TrajectoryRow(const TrajectoryStudy& study,
                                     const TrajectoryMetric& metric,
                                     const PipelineOptions& options,
                                     const PipelineResult& result);

// "straight" or "repaired" (or "planner", the same).  Throws InputError
// starting with the flag's name.
TrajectoryStart ParseStart(const std::string& text);
const char* ToString(TrajectoryStart start);

}  // namespace phongpd
