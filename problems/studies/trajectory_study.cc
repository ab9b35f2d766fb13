// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/trajectory_study.h"

#include <memory>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/text.h"
#include "problems/studies/window_trajectory.h"

namespace phongpd {
namespace {

// "phong@0.2/tangent-plane/exact".
std::string PhongName(const Length& length,
                      const SignedMetricOptions& options) {
  std::string name = "phong@" + length.Text();
  if (options.phong.field == FieldKind::kTangentPlane) name += "/tangent-plane";
  if (options.jacobian == JacobianKind::kExact) name += "/exact";
  return name;
}

}  // namespace

TrajectoryMetric ParseTrajectoryMetric(const std::string& text,
                                       const std::string& what) {
  TrajectoryMetric metric;
  metric.name = text;
  if (text == "euclidean") {
    metric.options.metric = MetricKind::kEuclidean;
    return metric;
  }
  const std::string prefix = "phong@";
  if (text.compare(0, prefix.size(), prefix) != 0) {
    throw InputError(what +
                     ": expected euclidean, phong@LENGTH, phong@LENGTH/exact "
                     "or phong@LENGTH/tangent-plane, found '" +
                     text + "'");
  }
  std::string rest = text.substr(prefix.size());
  const auto strip = [&rest](const std::string& suffix) {
    if (rest.size() < suffix.size() ||
        rest.compare(rest.size() - suffix.size(), suffix.size(), suffix) != 0) {
      return false;
    }
    rest.resize(rest.size() - suffix.size());
    return true;
  };
  if (strip("/exact")) metric.options.jacobian = JacobianKind::kExact;
  if (strip("/tangent-plane")) {
    metric.options.phong.field = FieldKind::kTangentPlane;
  }
  const std::string place = what + ": smoothing_length";
  metric.smoothing_length = ParseLength(rest, place);
  RequireLength(metric.smoothing_length, LengthRange::kFromZero, 0.0, place);
  return metric;
}

TrajectoryMetric SceneMetric(const Scene& scene) {
  const PenetrationSettings& settings = scene.penetration;
  TrajectoryMetric metric;
  if (settings.metric == "euclidean") {
    metric.name = settings.metric;
    metric.options.metric = MetricKind::kEuclidean;
    return metric;
  }
  if (settings.field == "tangent-plane") {
    metric.options.phong.field = FieldKind::kTangentPlane;
  }
  if (settings.jacobian == "exact") {
    metric.options.jacobian = JacobianKind::kExact;
  }
  metric.smoothing_length = settings.smoothing_length;
  metric.name = PhongName(metric.smoothing_length, metric.options);
  return metric;
}

void TrajectoryStudy::Enter(const Scene& scene) {
  const bool is_known = world_ &&
                        HaveSameSolids(scene.workspace, world_->workspace()) &&
                        scene.trajectory.model == scene_.trajectory.model;
  scene_ = scene;
  if (is_known) return;
  choice_ = ModelChoice(scene.trajectory.model);
  problems_.clear();
  repair_.reset();
  world_.emplace(scene_.workspace, scene_.name, cache_, limits_);
}

void TrajectoryStudy::Enter(const Scene& scene, const World& world) {
  RequireSameSolids(scene.workspace, world, scene.name);
  choice_ = ModelChoice(scene.trajectory.model);
  scene_ = scene;
  problems_.clear();
  repair_.reset();
  world_ = world;
}

std::size_t TrajectoryStudy::triangles() const {
  const WorldSpaces* built = world().Built(layout_);
  return built == nullptr ? 0 : built->triangles;
}

std::optional<ResolvedLength> TrajectoryStudy::SmoothingLength(
    const TrajectoryMetric& metric) const {
  if (metric.options.metric != MetricKind::kPhong) return std::nullopt;
  RequireLength(metric.smoothing_length, LengthRange::kFromZero,
                world().diagonal(), metric.name + ": smoothing_length");
  return world().Resolve(metric.smoothing_length);
}

// Lengths as shares of D.
SignedMetricOptions TrajectoryStudy::WorldOptions(
    const TrajectoryMetric& metric) const {
  SignedMetricOptions options = metric.options;
  if (const auto length = SmoothingLength(metric)) {
    options.phong.field_options.smoothing_length = length->share;
  }
  return options;
}

TrajectoryProblem TrajectoryStudy::Settings() const {
  const TrajectorySettings& settings = scene_.trajectory;
  TrajectoryProblem problem;
  problem.diagonal = world().diagonal();
  problem.start = scene_.start;
  problem.goal = scene_.goal;
  problem.waypoints = settings.waypoints;
  problem.samples_per_segment = settings.samples_per_segment;
  problem.margin = world().Resolve(settings.margin).share;
  problem.max_segment_ratio = settings.max_segment_ratio;
  return problem;
}

TrajectoryProblem TrajectoryStudy::Problem(const TrajectoryMetric& metric) {
  auto found = problems_.find(metric.name);
  if (found == problems_.end()) {
    const SignedMetricOptions of_world = WorldOptions(metric);
    TrajectoryProblem problem;
    problem.free_space = spaces().free_space;
    for (const ContactSpace& space : spaces().spaces) {
      problem.metrics.push_back(
          metric.make ? std::make_shared<SignedMetric>(
                            space, metric.make(space, of_world.phong), of_world)
                      : std::make_shared<SignedMetric>(space, of_world));
    }
    found = problems_.emplace(metric.name, std::move(problem)).first;
  }
  TrajectoryProblem problem = Settings();
  problem.metrics = found->second.metrics;
  problem.free_space = found->second.free_space;
  return problem;
}

// False: start or goal is not free, and the result says so.
bool TrajectoryStudy::Diagnose(PipelineResult* result) const {
  for (const bool at_start : {true, false}) {
    const Diagnosis diagnosis =
        world().Diagnose(at_start ? scene_.start : scene_.goal);
    if (diagnosis.IsFree()) continue;
    result->status = diagnosis.IsOnlyOutOfBounds()
                         ? at_start ? TrajectoryStatus::kStartOutOfBounds
                                    : TrajectoryStatus::kGoalOutOfBounds
                     : at_start ? TrajectoryStatus::kStartInCollision
                                : TrajectoryStatus::kGoalInCollision;
    result->reason = diagnosis.Text(at_start ? "start" : "goal");
    return false;
  }
  return true;
}

// Start repair needs the sealed space as well.
bool TrajectoryStudy::UsesWindow(TrajectoryStart start) {
  std::vector<SpaceLayout> layouts;
  if (start != TrajectoryStart::kStraight) {
    layouts.push_back(SpaceLayout::kSealed);
  }
  layouts.push_back(layout_);
  return choice_.UsesWindow(world(), layouts);
}

const FreeSpace& TrajectoryStudy::judge() const {
  return used_model_ == "window" ? *world().Convolution().free_space
                                 : *spaces().free_space;
}

std::vector<CorridorPlane> TrajectoryStudy::Corridor(const Path& path) const {
  TrajectoryProblem problem = Settings();
  problem.free_space = used_model_ == "window"
                           ? world().Convolution().free_space
                           : spaces().free_space;
  return PlanesAround(problem, path);
}

BoundingBox TrajectoryStudy::Region() const {
  if (!scene_.workspace.bounds.IsEmpty()) return scene_.workspace.bounds;
  return SamplingRegion(*world().Convolution().free_space, scene_.start,
                        scene_.goal);
}

PipelineResult TrajectoryStudy::RunInWindow(const PipelineOptions& options) {
  TrajectoryProblem problem = Settings();
  problem.free_space = world().Convolution().free_space;
  const MotionDomain domain = {problem.free_space, Region()};
  return OptimizeInFreeSpace(problem, domain, options,
                             scene_.planning.time_limit);
}

PipelineResult TrajectoryStudy::Run(const TrajectoryMetric& metric,
                                    const PipelineOptions& options) {
  // Bad options are refused, and blocked ends are told, before anything is
  // built: the pipeline's own checks need no contact space.
  TrajectoryProblem empty = Settings();
  empty.free_space = std::make_shared<FreeSpace>(std::vector<ContactSpace>());
  PipelineOptions straight = options;
  straight.start = TrajectoryStart::kStraight;
  TrajectoryPipeline(empty, nullptr, straight);
  metric.options.Validate();
  SmoothingLength(metric);
  PipelineResult result;
  used_model_ = "none";
  if (!Diagnose(&result)) return result;

  const bool is_window = UsesWindow(options.start);
  used_model_ = is_window ? "window" : "full";
  if (is_window) {
    result = RunInWindow(options);
  } else {
    result = RunInFull(metric, options);
  }
  const bool at_start = result.status == TrajectoryStatus::kStartInCollision;
  if (at_start || result.status == TrajectoryStatus::kGoalInCollision) {
    result.reason = BlockedByRounding(at_start ? scene_.start : scene_.goal,
                                      at_start ? "start" : "goal");
  }
  return result;
}

PipelineResult TrajectoryStudy::RunInFull(const TrajectoryMetric& metric,
                                          const PipelineOptions& options) {
  if (options.start != TrajectoryStart::kStraight && repair_ == nullptr) {
    repair_ = std::make_shared<StartRepair>(world().Sealed());
  }
  return TrajectoryPipeline(Problem(metric), repair_, options).Solve();
}

void ApplyPreset(Preset preset, PipelineOptions* options) {
  if (preset == Preset::kFast) options->also_line = false;
  if (preset == Preset::kTight) {
    options->routes = 3;
    options->polish = PolishWhen::kAlways;
  }
}

PipelineOptions ScenePipelineOptions(const Scene& scene) {
  PipelineOptions options;
  ApplyPreset(scene.preset, &options);
  for (const auto& [name, value] : scene.trajectory.ipopt) {
    std::string text;
    if (const int* whole = std::get_if<int>(&value)) {
      text = std::to_string(*whole);
    } else if (const double* number = std::get_if<double>(&value)) {
      text = FormatDouble(*number);
    } else {
      text = std::get<std::string>(value);
    }
    options.optimizer.ipopt.ipopt_options[name] = text;
  }
  return options;
}

TrajectoryStart ParseStart(const std::string& text) {
  if (text == "straight") return TrajectoryStart::kStraight;
  // Repair is done by the complete planner.
  if (text == "repaired" || text == "planner") {
    return TrajectoryStart::kRepaired;
  }
  throw InputError("--start: expected straight, repaired or planner, found '" +
                   text + "'");
}

const char* ToString(TrajectoryStart start) {
  return start == TrajectoryStart::kStraight ? "straight" : "repaired";
}

}  // namespace phongpd
