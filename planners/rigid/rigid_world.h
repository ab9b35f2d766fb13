// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

namespace internal {
struct RigidModel;
}  // namespace internal

// A robot that translates and turns among fixed obstacles, for Plan and
// Optimize (rigid_plan.h, rigid_optimize.h): the meshes, their judge, and the
// trees in which planners find contacts.  The meshes need not be closed
// (rigid_judge.h).
//
// Lengths of motions are measured in the object norm, user's unit.  For a
// displacement Δq of the robot's origin and a turn by θ ≤ π it is
//
//   √(|Δq|² + L² θ²),   L = √(∫ |p|² dA / ∫ dA)
//
// with L the radius of gyration of the robot's surface about its origin.
//
// An immutable handle, cheap to copy.  Thread-safe.
class RigidWorld {
 public:
  // Throws InputError like RigidJudge, and for a robot that is only a point at
  // its origin, because L would be 0.
  RigidWorld(const TriangleMesh& robot, const TriangleMesh& obstacle);
  // All meshes of `robot` move together as one body.
  RigidWorld(const std::vector<TriangleMesh>& robot,
             const std::vector<TriangleMesh>& obstacles);

  const RigidJudge& judge() const;
  const std::vector<TriangleMesh>& robot() const;
  const std::vector<TriangleMesh>& obstacles() const;

  double gyration() const;  // L > 0
  double reach() const;     // > 0, the distance of the robot's farthest corner
                            // from its origin
  // The box of all obstacles.
  Eigen::AlignedBox3d obstacle_box() const;

  // The object norm of the motion from a to b by the shorter turn.  Requires
  // finite poses with quaternions of unit length.
  double Distance(const RobotPose& a, const RobotPose& b) const;

  // For planners; its header is not installed.
  const internal::RigidModel& model() const { return *model_; }

 private:
  std::shared_ptr<const internal::RigidModel> model_;
};

}  // namespace phongpd
