// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/optimize_request.h"

#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/world/bare_length.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_requests.h"

namespace phongpd::cli {
namespace {

// What says how a metric is followed says nothing where none is; windows know
// some metrics, one row a sample (optimize.h).
void RequireMetricIsFollowed(const OptimizeFlags& flags, const Scene& scene) {
  if (scene.trajectory.model != Model::kWindow) return;
  const MetricKind metric = scene.penetration.metric;
  if (metric != MetricKind::kPhong) {
    if (flags.rows == 1 && !flags.per_obstacle) return;
    throw InputError(
        std::string(flags.per_obstacle ? "--per-obstacle" : "--rows") +
        ": expected none with model window and metric " + ToString(metric) +
        ", which windows follow by one row a sample, found one; take --model "
        "full");
  }
  for (const auto& [name, value] :
       {std::make_pair("--metric", flags.metric),
        std::make_pair("--smoothing-length", flags.smoothing_length),
        std::make_pair("--jacobian", flags.jacobian)}) {
    if (value.empty()) continue;
    throw InputError(std::string(name) +
                     ": expected none with model window, which follows no "
                     "penetration metric but euclidean and smoothed, found " +
                     value + "; take --model full");
  }
}

void TakeBudget(const OptimizeFlags& flags, Scene* scene) {
  if (flags.budget.empty()) return;
  OptimizeRequest request;
  ApplyBudget(BudgetOf(flags.budget), scene->workspace, &request);
  scene->preset = request.preset;
  scene->trajectory.model = request.model;
  scene->penetration.metric = request.penetration.metric;
}

}  // namespace

void OverrideScene(const OptimizeFlags& flags, Scene* scene) {
  TakeBudget(flags, scene);
  SetPreset(flags.preset, scene);
  if (!flags.model.empty()) {
    scene->trajectory.model = ParseModel(flags.model, "--model");
  }
  PenetrationSpec& spec = scene->penetration;
  if (!flags.metric.empty()) {
    spec.metric = ParseMetricKind(flags.metric, "--metric");
  }
  if (!flags.jacobian.empty()) {
    spec.jacobian = ParseJacobianKind(flags.jacobian, "--jacobian");
  }
  if (!flags.smoothing_length.empty()) {
    spec.smoothing_length =
        LengthFlag(flags.smoothing_length, "--smoothing-length",
                   LengthRange::kFromZero, scene);
  }
  RequireMetricIsFollowed(flags, *scene);
  if (!flags.margin.empty()) {
    scene->trajectory.margin = ParseClearance(
        flags.margin, "--margin", ContactBounds(scene->workspace).Diagonal(),
        scene->workspace.unit);
  }
}

OptimizeRequest PathRequestOf(const OptimizeFlags& flags, const Scene& scene,
                              std::uint64_t seed) {
  OptimizeRequest request = OptimizeRequestOf(scene);
  request.limits.reset();
  // Also where it is what it would be without the flag.
  if (!flags.margin.empty()) request.margin = scene.trajectory.margin;
  request.requires_margin = flags.require;
  request.is_per_obstacle = flags.per_obstacle;
  request.verifies = flags.verify;
  PipelineOptions& options = request.options;
  // Repair is done by the complete planner: two words for the same.
  options.start = flags.start == "straight" ? TrajectoryStart::kStraight
                                            : TrajectoryStart::kRepaired;
  options.start_noise = ParseDouble(flags.noise, "--start-noise");
  if (options.start_noise > 0.0 &&
      options.start != TrajectoryStart::kStraight) {
    throw InputError(
        "--start-noise: expected --start straight with it, found " +
        flags.start);
  }
  if (flags.app->count("--routes") > 0) options.routes = flags.routes;
  if (flags.app->count("--line") > 0) options.also_line = flags.line;
  options.seed = seed;
  if (!flags.polish.empty()) {
    options.polish = flags.polish == "never"    ? PolishWhen::kNever
                     : flags.polish == "always" ? PolishWhen::kAlways
                                                : PolishWhen::kNeeded;
  }
  options.optimizer.rows = flags.rows;
  if (flags.mu_strategy == "monotone") {
    options.optimizer.ipopt.mu_strategy = IpoptSettings::MuStrategy::kMonotone;
  }
  if (!flags.time_limit.empty()) {
    options.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  options.optimizer.ipopt.on_iteration = [](const IterationRecord& record,
                                            const Eigen::VectorXd&) {
    if (record.iteration % 25 == 0) {
      Progress("  iteration " + std::to_string(record.iteration) +
               ", objective " + FormatDouble(record.objective) +
               ", violation " + FormatDouble(record.violation));
    }
    return true;
  };
  return request;
}

}  // namespace phongpd::cli
