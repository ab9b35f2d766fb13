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

// A robot that moves and turns among fixed obstacles: the meshes, their judge,
// and the trees that planners look for contacts in.  Surfaces need not be
// closed (rigid_judge.h).
//
// The object norm measures motions: of a displacement Δq of the robot's origin
// and a turn by θ ≤ π it is √(|Δq|² + L² θ²), user's unit, with L the robot's
// radius of gyration about its origin, by area: √(∫ |p|² dA / ∫ dA).
//
// An immutable handle, cheap to copy and thread-safe.
class RigidWorld {
 public:
  // Throws InputError like RigidJudge, and for a robot that is but a point at
  // its own origin, whose turns nothing could measure.
  RigidWorld(const TriangleMesh& robot, const TriangleMesh& obstacle);
  // The robot is all of `robot` at once, so are the obstacles.
  RigidWorld(const std::vector<TriangleMesh>& robot,
             const std::vector<TriangleMesh>& obstacles);

  const RigidJudge& judge() const;
  const std::vector<TriangleMesh>& robot() const;
  const std::vector<TriangleMesh>& obstacles() const;

  double gyration() const;  // L > 0
  double reach() const;     // R > 0, of the robot's farthest corner from its
                            // origin
  // The box of all obstacles.
  Eigen::AlignedBox3d obstacle_box() const;

  // The object norm of the shorter way from pose to pose; of poses as CheckPose
  // wants them.
  double Distance(const RobotPose& a, const RobotPose& b) const;

  // What planners search in; not installed.
  const internal::RigidModel& model() const { return *model_; }

 private:
  std::shared_ptr<const internal::RigidModel> model_;
};

}  // namespace phongpd
