// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/exact_solution.h"

#include "constraints/motion_oracle.h"
#include "core/stopwatch.h"

namespace phongpd {

using Eigen::Vector3d;

std::string NameObstacles(const Workspace& workspace, const Vector3d& q) {
  std::string names;
  const auto add = [&](const std::string& name) {
    names += (names.empty() ? "" : ", ") + name;
  };
  for (const int i : ReachableObstacles(workspace)) {
    const Solid& obstacle = workspace.obstacles[static_cast<std::size_t>(i)];
    if (MotionOracle(workspace.robot, obstacle).Collides(q)) {
      add(obstacle.name());
    }
  }
  const BoundingBox& bounds = workspace.bounds;
  if (!bounds.IsEmpty() && !((q.array() > bounds.min.array()).all() &&
                             (q.array() < bounds.max.array()).all())) {
    add("bounds");
  }
  return names;
}

ExactSolution SolveExactly(const Workspace& workspace, const Vector3d& start,
                           const Vector3d& goal,
                           const ContactSurfaceOptions& options,
                           const ContactSpaceOptions& contact_options) {
  workspace.Validate();
  options.Validate();
  ExactSolution solution;
  const Stopwatch stopwatch;
  const ContactSpace space = BuildContactSpace(
      workspace.robot, MergedObstacle(workspace), contact_options);
  solution.contact_space_seconds = stopwatch.Seconds();
  solution.contact_space = space.report();
  const ContactSurfacePlanner planner(space, options, [&](const Vector3d& q) {
    return NameObstacles(workspace, q);
  });
  solution.planner_seconds = planner.build_seconds();
  solution.plan = planner.Plan(start, goal);
  return solution;
}

}  // namespace phongpd
