// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/workspace.h"

#include <algorithm>
#include <set>

#include "constraints/free_space.h"
#include "constraints/motion_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// The 12 outward triangles of a box.
TriangleMesh BoxMesh(const BoundingBox& box) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    Vector3d v;
    for (int k = 0; k < 3; ++k) {
      v[k] = (corner >> k & 1) != 0 ? box.max[k] : box.min[k];
    }
    mesh.vertices.push_back(v);
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                    {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

}  // namespace

void Workspace::Validate() const {
  RequireNotEmpty(robot, "robot");
  std::set<std::string> names;
  for (const Solid& obstacle : obstacles) {
    RequireNotEmpty(obstacle, "obstacle");
    if (!names.insert(obstacle.name()).second) {
      throw InputError("obstacle '" + obstacle.name() +
                       "': the name is used twice");
    }
  }
  FreeSpace::CheckBounds(bounds);
  const bool none = (bounds.min.array() > bounds.max.array()).all();
  if (!none && !(bounds.min.array() < bounds.max.array()).all()) {
    throw InputError("bounds: expected min < max in x, y and z");
  }
}

Solid BoundsShell(const Workspace& workspace) {
  const BoundingBox robot = ComputeBounds(workspace.robot);
  const BoundingBox inner = {workspace.bounds.min + robot.min,
                             workspace.bounds.max + robot.max};
  // As thick as the cavity is wide: thinner saves nothing, and the outside of
  // the shell stays far from everything inside.
  const double wall = (inner.max - inner.min).maxCoeff();
  return MakeSolid(
      Joined(BoxMesh({inner.min.array() - wall, inner.max.array() + wall}),
             Reversed(BoxMesh(inner))),
      "bounds");
}

Solid JoinedObstacle(const Workspace& workspace) {
  std::vector<Solid> parts;
  for (const int i : ReachableObstacles(workspace)) {
    parts.push_back(workspace.obstacles[static_cast<std::size_t>(i)]);
  }
  return JoinedSolids(parts, "obstacles");
}

Solid MergedObstacle(const Workspace& workspace) {
  const bool has_bounds = !workspace.bounds.IsEmpty();
  std::vector<Solid> parts = {JoinedObstacle(workspace)};
  if (has_bounds) parts.push_back(BoundsShell(workspace));
  const Solid merged =
      JoinedSolids(parts, has_bounds ? "obstacles and bounds" : "obstacles");
  if (merged.IsEmpty()) {
    throw InputError("workspace: expected an obstacle or bounds, found none");
  }
  return merged;
}

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

BoundingBox ContactBounds(const Workspace& workspace) {
  const BoundingBox robot = ComputeBounds(workspace.robot);
  const std::vector<int> reachable = ReachableObstacles(workspace);
  if (reachable.empty()) return workspace.bounds;
  BoundingBox box;
  for (std::size_t k = 0; k < reachable.size(); ++k) {
    const BoundingBox one = ComputeBounds(
        workspace.obstacles[static_cast<std::size_t>(reachable[k])]);
    if (k == 0) box = one;
    box.min = box.min.cwiseMin(one.min);
    box.max = box.max.cwiseMax(one.max);
  }
  return {box.min - robot.max, box.max - robot.min};
}

std::vector<int> ReachableObstacles(const Workspace& workspace) {
  const BoundingBox robot = ComputeBounds(workspace.robot);
  std::vector<int> reachable;
  for (std::size_t i = 0; i < workspace.obstacles.size(); ++i) {
    const BoundingBox box = ComputeBounds(workspace.obstacles[i]);
    // The box of B ⊕ (−A), wider by more than it can be rounded.
    const double rounding =
        1e-12 * (robot.Diagonal() +
                 box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff());
    const Vector3d min = (box.min - robot.max).array() - rounding;
    const Vector3d max = (box.max - robot.min).array() + rounding;
    if (workspace.bounds.IsEmpty() ||
        ((min.array() <= workspace.bounds.max.array()).all() &&
         (max.array() >= workspace.bounds.min.array()).all())) {
      reachable.push_back(static_cast<int>(i));
    }
  }
  return reachable;
}

}  // namespace phongpd
