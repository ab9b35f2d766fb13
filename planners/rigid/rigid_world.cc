// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_world.h"

#include <algorithm>
#include <cmath>

#include "core/mesh/mesh_error.h"
#include "planners/rigid/object_norm.h"
#include "planners/rigid/rigid_model.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

double ReachOf(const std::vector<TriangleMesh>& meshes) {
  double reach = 0.0;
  for (const TriangleMesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      for (const int v : t) {
        reach =
            std::max(reach, mesh.vertices[static_cast<std::size_t>(v)].norm());
      }
    }
  }
  return reach;
}

// ∫ |p|² dA of a triangle is its area times the mean of |p|² at the middles of
// its edges.  A robot without area has no inertia; its reach does as well.
double GyrationOf(const std::vector<TriangleMesh>& meshes, double reach) {
  double sum = 0.0, areas = 0.0;
  for (const TriangleMesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      const Vector3d& a = mesh.vertices[static_cast<std::size_t>(t[0])];
      const Vector3d& b = mesh.vertices[static_cast<std::size_t>(t[1])];
      const Vector3d& c = mesh.vertices[static_cast<std::size_t>(t[2])];
      const double area = (b - a).cross(c - a).norm();
      sum += area *
             ((a + b).squaredNorm() + (b + c).squaredNorm() +
              (c + a).squaredNorm()) /
             12.0;
      areas += area;
    }
  }
  const double gyration = areas > 0.0 ? std::sqrt(sum / areas) : 0.0;
  return gyration > 0.0 ? gyration : reach;
}

Eigen::AlignedBox3d BoxOf(const std::vector<TriangleMesh>& meshes) {
  Eigen::AlignedBox3d box;
  for (const TriangleMesh& mesh : meshes) {
    const BoundingBox bounds = ComputeBounds(mesh);
    box.extend(bounds.min);
    box.extend(bounds.max);
  }
  return box;
}

internal::RigidModel MakeModel(const std::vector<TriangleMesh>& robot,
                               const std::vector<TriangleMesh>& obstacles) {
  // Judges the meshes first: what follows trusts them.
  RigidJudge judge(robot, obstacles);
  const double reach = ReachOf(robot);
  if (!(reach > 0.0)) {
    throw InputError(
        "rigid world: expected a robot of some size, found only a point at its "
        "own origin; plan for a robot that translates");
  }
  return {robot,
          obstacles,
          std::move(judge),
          internal::ContactSurface(robot),
          internal::ContactSurface(obstacles),
          internal::AlignedFeatures(robot, obstacles),
          GyrationOf(robot, reach),
          reach,
          BoxOf(obstacles)};
}

}  // namespace

RigidWorld::RigidWorld(const TriangleMesh& robot, const TriangleMesh& obstacle)
    : RigidWorld(std::vector<TriangleMesh>{robot},
                 std::vector<TriangleMesh>{obstacle}) {}

RigidWorld::RigidWorld(const std::vector<TriangleMesh>& robot,
                       const std::vector<TriangleMesh>& obstacles)
    : model_(std::make_shared<const internal::RigidModel>(
          MakeModel(robot, obstacles))) {}

const RigidJudge& RigidWorld::judge() const { return model_->judge; }
const std::vector<TriangleMesh>& RigidWorld::robot() const {
  return model_->robot;
}
const std::vector<TriangleMesh>& RigidWorld::obstacles() const {
  return model_->obstacles;
}
double RigidWorld::gyration() const { return model_->gyration; }
double RigidWorld::reach() const { return model_->reach; }
Eigen::AlignedBox3d RigidWorld::obstacle_box() const {
  return model_->obstacle_box;
}
double RigidWorld::Distance(const RobotPose& a, const RobotPose& b) const {
  return internal::ObjectDistance(a, b, model_->gyration);
}

}  // namespace phongpd
