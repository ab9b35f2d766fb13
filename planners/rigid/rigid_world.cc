// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/rigid/rigid_world.h"

#include <algorithm>

#include "constraints/gyration.h"
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

// A robot without area has no inertia; its reach does as well.
double GyrationOf(const std::vector<TriangleMesh>& meshes, double reach) {
  const double gyration = internal::RadiusOfGyration(meshes);
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
