// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planners/rigid/rigid_links.h"
#include "planners/rigid/rigid_model.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd::internal {

struct PathDescentTask {
  Eigen::AlignedBox3d bounds;  // of the robot's origin
  double margin = 0.0;         // at the samples, user's unit; > 0
  int max_rounds = 100;
};

struct PathDescentEnd {
  std::vector<RobotPose> path;  // free, proved; no longer than the start
  double length = 0.0;          // its, object norm
  // kConverged: no step of 2 % of the reach shortens it by 1e-4 or more, to
  // first order.  kStalledFeasible: steps are refused down to 1e-4 of the
  // reach, or what converged is longer, as it gives places more room.
  // kIterationLimit: of the rounds; kTimeLimit, kCancelled: stopped.
  SolveStatus status = SolveStatus::kIterationLimit;
  bool was_refuted = false;  // a step that Ipopt called solved did collide
  int steps = 0;             // taken: solved by Ipopt's word, and proved
  int rounds = 0, iterations = 0;
  std::size_t samples = 0, added_samples = 0;
  long checks = 0, tests = 0;  // of the judge
};

// Shortens a path of three poses or more, every motion of which is proved
// free; its ends stay.  Each round is a LinearStep from the path, solved by
// Ipopt, with rows at the middle and the end of each link.  The judge has to
// prove every motion of the new path, and length and what places lack of the
// margin (LinearStep::kPenalty) have to be less, or it is not taken; then half
// of the step is tried, and a quarter.  Where a step collides between samples
// it gets one there; else steps get shorter.  So at any moment there is a
// proved path, and the shortest is what is answered.
PathDescentEnd DescendPath(const RigidModel& model,
                           const std::vector<RobotPose>& start,
                           const PathDescentTask& task, RigidStop* stop);

}  // namespace phongpd::internal
