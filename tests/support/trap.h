// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "planners/trajectory/trajectory_problem.h"
#include "problems/shapes/shapes.h"

// A trap that straight paths run into.
namespace phongpd::testing {

// A U of side 2 around the origin, open towards +x, turned by
// GenericRotation(); taken as a contact space.
inline TriangleMesh Trap() {
  return Rotated(Translated(MakeU(2.0, 0.4, 1.0), {-1.0, -1.0, -0.5}),
                 GenericRotation());
}

// A problem with ends given in the frame of the U before its rotation; its
// arms lie at |y| between 0.6 and 1.
inline TrajectoryProblem TrapProblem(const Eigen::Vector3d& start,
                                     const Eigen::Vector3d& goal,
                                     const SignedMetricOptions& options) {
  TrajectoryProblem problem =
      MakeTrajectoryProblem({TakeAsContactSpace(Trap())}, options);
  problem.start = GenericRotation() * start;
  problem.goal = GenericRotation() * goal;
  return problem;
}

}  // namespace phongpd::testing
