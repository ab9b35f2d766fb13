// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "core/contact_space/grid_solid.h"
#include "core/contact_space/solid_collision.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::testing {

// Do the solids A + q and B share a point?  Answered by exact predicates on
// the original meshes, rounded to the grid (2⁻³⁸ of the larger one) and
// nothing else: no convolution, no arrangement, no contact space.
class ExactCollision {
 public:
  // Both as MakeSolid returns them.
  ExactCollision(const TriangleMesh& robot, const TriangleMesh& obstacle)
      : frame_(internal::ChooseGridFrame(robot, obstacle)),
        judge_(internal::MakeGridSolid(obstacle, frame_.obstacle_center,
                                       frame_.step, false, "obstacle"),
               internal::MakeGridSolid(robot, frame_.robot_center, frame_.step,
                                       true, "robot")) {}

  // Exact for q rounded to 2⁻¹² grid steps.
  bool Collides(const Eigen::Vector3d& q) const {
    return judge_.Collide((q - frame_.Origin()) / frame_.step);
  }

 private:
  internal::GridFrame frame_;
  internal::SolidCollision judge_;
};

}  // namespace phongpd::testing
