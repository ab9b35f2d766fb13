// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/studies/trajectory_study.h"

#include <memory>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/output/text.h"

namespace phongpd {
namespace {

bool IsSame(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles;
}

bool HasSameSolids(const Workspace& a, const Workspace& b) {
  if (!IsSame(a.robot, b.robot) || a.obstacles.size() != b.obstacles.size() ||
      a.bounds.min != b.bounds.min || a.bounds.max != b.bounds.max) {
    return false;
  }
  for (std::size_t i = 0; i < a.obstacles.size(); ++i) {
    if (!IsSame(a.obstacles[i].mesh, b.obstacles[i].mesh)) return false;
  }
  return true;
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
  metric.options.phong.field_options.smoothing_length =
      ParseDouble(rest, what + ": smoothing length");
  metric.options.Validate();
  return metric;
}

TrajectoryMetric SceneMetric(const Scene& scene) {
  const PenetrationSettings& settings = scene.penetration;
  if (settings.metric == "euclidean") {
    return ParseTrajectoryMetric("euclidean", scene.name);
  }
  std::string name = "phong@" + FormatDouble(settings.smoothing_length);
  if (settings.field == "tangent-plane") name += "/tangent-plane";
  if (settings.jacobian == "exact") name += "/exact";
  return ParseTrajectoryMetric(name, scene.name);
}

void TrajectoryStudy::Enter(const Scene& scene) {
  const bool is_known = space_.free_space != nullptr &&
                        HasSameSolids(scene.workspace, scene_.workspace);
  scene_ = scene;
  if (is_known) return;
  problems_.clear();
  repair_.reset();
  space_ = BuildSceneSpace(scene_, layout_, cache_);
}

TrajectoryProblem TrajectoryStudy::Problem(const TrajectoryMetric& metric) {
  auto found = problems_.find(metric.name);
  if (found == problems_.end()) {
    TrajectoryProblem problem;
    problem.free_space = space_.free_space;
    problem.diagonal = space_.diagonal;
    for (const ContactSpace& one : space_.contact_spaces) {
      problem.metrics.push_back(
          std::make_shared<SignedMetric>(one, metric.options));
    }
    found = problems_.emplace(metric.name, std::move(problem)).first;
  }
  TrajectoryProblem problem = found->second;
  const TrajectorySettings& settings = scene_.trajectory;
  problem.start = scene_.start;
  problem.goal = scene_.goal;
  problem.waypoints = settings.waypoints;
  problem.samples_per_segment = settings.samples_per_segment;
  problem.margin = settings.margin;
  problem.max_segment_ratio = settings.max_segment_ratio;
  return problem;
}

PipelineResult TrajectoryStudy::Run(const TrajectoryMetric& metric,
                                    const PipelineOptions& options) {
  if (options.start != TrajectoryStart::kStraight && repair_ == nullptr) {
    repair_ = std::make_shared<StartRepair>(*space_.sealed);
  }
  PipelineResult result =
      TrajectoryPipeline(Problem(metric), repair_, options).Solve();
  const bool at_start = result.status == TrajectoryStatus::kStartInCollision;
  if (at_start || result.status == TrajectoryStatus::kGoalInCollision) {
    result.reason =
        EndInCollision(scene_, space_, at_start ? scene_.start : scene_.goal,
                       at_start ? "start" : "goal");
  }
  return result;
}

PipelineOptions ScenePipelineOptions(const Scene& scene) {
  PipelineOptions options;
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

BranchPolicy ParsePolicy(const std::string& text) {
  for (const BranchPolicy policy :
       {BranchPolicy::kCommit, BranchPolicy::kStateless,
        BranchPolicy::kOuterRestart}) {
    if (text == ToString(policy)) return policy;
  }
  throw InputError(
      "--policy: expected commit, stateless or outer-restart, found '" + text +
      "'");
}

const char* ToString(TrajectoryStart start) {
  return start == TrajectoryStart::kStraight ? "straight" : "repaired";
}

const char* ToString(BranchPolicy policy) {
  switch (policy) {
    case BranchPolicy::kStateless:
      return "stateless";
    case BranchPolicy::kOuterRestart:
      return "outer-restart";
    case BranchPolicy::kCommit:
      break;
  }
  return "commit";
}

}  // namespace phongpd
