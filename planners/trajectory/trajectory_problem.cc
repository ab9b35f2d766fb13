// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/trajectory_problem.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "constraints/sampling_rule.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "planners/world/world.h"

namespace phongpd {

namespace {

using Eigen::Vector3d;

void FailField(const std::string& field, const std::string& expected,
               const std::string& found) {
  throw InputError("trajectory: " + field + ": expected " + expected +
                   ", found " + found);
}

}  // namespace

void TrajectoryProblem::Validate() const {
  for (const auto& metric : metrics) {
    if (metric == nullptr)
      FailField("metrics", "one per contact space", "null");
  }
  if (free_space == nullptr) FailField("free_space", "the exact judge", "null");
  if (!IsFinite(start)) FailField("start", "finite numbers", "NaN or Inf");
  if (!IsFinite(goal)) FailField("goal", "finite numbers", "NaN or Inf");
  if (waypoints < 1 || waypoints > 10000) {
    FailField("waypoints", "1 to 10000", std::to_string(waypoints));
  }
  if (samples_per_segment < 0 || samples_per_segment > kMaxSamplesPerSegment) {
    FailField("samples_per_segment", "0 (by rule) to 1000",
              std::to_string(samples_per_segment));
  }
  if (!(margin >= 0.0 && margin <= 1.0)) {
    FailField("margin", "a fraction of the diagonal in [0, 1]",
              std::to_string(margin));
  }
  if (!(max_segment_ratio >= 1.0 && max_segment_ratio <= 1e6)) {
    FailField("max_segment_ratio", "1 to 1e6",
              std::to_string(max_segment_ratio));
  }
  if (!(diagonal >= 0.0) || !std::isfinite(diagonal)) {
    FailField("diagonal", "≥ 0 (0: of the contact spaces)",
              std::to_string(diagonal));
  }
  const double reach = (goal - start).stableNorm() / Diagonal(*this);
  if (!(reach < 1e6)) {
    FailField("start and goal", "less than 1e6 diagonals apart",
              std::to_string(reach));
  }
}

TrajectoryProblem MakeTrajectoryProblem(
    const std::vector<ContactSpace>& contact_spaces,
    const SignedMetricOptions& metric, const BoundingBox& bounds) {
  TrajectoryProblem problem;
  const std::vector<ContactSpace> spaces = WithCommonLength(contact_spaces);
  for (const ContactSpace& space : spaces) {
    problem.metrics.push_back(std::make_shared<SignedMetric>(space, metric));
  }
  problem.free_space = std::make_shared<FreeSpace>(spaces, bounds);
  if (!spaces.empty()) problem.diagonal = spaces[0].length();
  return problem;
}

TrajectoryProblem TrajectoryProblemIn(const World& world,
                                      const SignedMetricOptions& metric) {
  TrajectoryProblem problem =
      MakeTrajectoryProblem(world.Spaces(SpaceLayout::kMerged).spaces, metric,
                            world.workspace().bounds);
  problem.diagonal = world.diagonal();
  return problem;
}

double Diagonal(const TrajectoryProblem& problem) {
  if (problem.diagonal > 0.0) return problem.diagonal;
  std::vector<ContactSpace> spaces;
  for (const auto& metric : problem.metrics) {
    if (metric->HasSpace()) spaces.push_back(metric->space());
  }
  if (!spaces.empty()) {
    return WithCommonLength(std::move(spaces))[0].length();
  }
  const double length = (problem.goal - problem.start).stableNorm();
  return length > 0.0 && std::isfinite(length) ? length : 1.0;
}

double PathEnergy(const TrajectoryProblem& problem, const Path& path) {
  if (path.size() < 2) return 0.0;
  // Divided first: no length is squared in the user's unit.
  const double reference =
      std::max((problem.goal - problem.start).norm(), 1e-3 * Diagonal(problem));
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    sum += ((path[i + 1] - path[i]) / reference).squaredNorm();
  }
  return static_cast<double>(path.size() - 1) * sum;
}

void CheckStartPath(const TrajectoryProblem& problem, const Path& path) {
  const std::string what = "start path: expected ";
  const auto points = static_cast<std::size_t>(problem.waypoints) + 2;
  if (path.size() != points) {
    throw InputError(what + std::to_string(points) + " points, found " +
                     std::to_string(path.size()));
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!IsFinite(path[i])) {
      throw InputError(what + "finite points, found NaN or Inf at point " +
                       std::to_string(i));
    }
  }
  if (path.front() != problem.start || path.back() != problem.goal) {
    throw InputError(what +
                     "the problem's start and goal at its ends, found others");
  }
}

Path StraightPath(const TrajectoryProblem& problem) {
  Path path{problem.start};
  for (int i = 1; i <= problem.waypoints; ++i) {
    const double t = static_cast<double>(i) / (problem.waypoints + 1);
    path.push_back(problem.start + t * (problem.goal - problem.start));
  }
  path.push_back(problem.goal);
  return path;
}

double MaxSegment(const TrajectoryProblem& problem, double start_length) {
  const double straight = (problem.goal - problem.start).norm();
  return problem.max_segment_ratio * std::max(straight, start_length) /
         (problem.waypoints + 1);
}

int SamplesPerSegment(const TrajectoryProblem& problem, double start_length) {
  if (problem.samples_per_segment > 0) return problem.samples_per_segment;
  return SamplesByRule(MaxSegment(problem, start_length),
                       problem.margin * Diagonal(problem));
}

}  // namespace phongpd
