// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "planners/rigid/optimizer/pose_program.h"
#include "planners/rigid/rigid_links.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd::internal {

struct PoseRoundsTask {
  Eigen::AlignedBox3d bounds;  // of the robot's origin
  double margin = 0.0;         // of the rows, user's unit; > 0
  int max_rounds = 1;
  int max_iterations = 100;  // of a round
  int max_failures = 3;  // in a row, of rounds that Ipopt does not call solved
  double time_limit = 0.0;  // seconds of all rounds
};

struct PoseRoundsEnd {
  std::vector<RobotPose>
      path;  // every motion of it is proved free; empty: none
  SolveStatus status = SolveStatus::kInvalidProblem;  // of the last round
  // At least once the judge refuted what Ipopt called solved.
  bool was_refuted = false;
  int rounds = 0, iterations = 0;
  std::size_t samples = 0, added_samples = 0;
  long checks = 0, tests = 0;  // of the judge
};

// At the middle and the end of each link.
std::vector<PoseSample> FirstSamples(int links, double margin);

// Makes of a path of three poses or more, whose ends stay, a free one.  Each
// round is a solve of PoseProgram, FirstSamples in the first, around the poses
// of the round before.  Then each part between two samples is judged for all of
// its t.  Where it is not free it gets a sample where it was seen to collide,
// or is not decided, whose margin is doubled with each round that added some to
// the link before; where two samples are close already (kLeastPart of the
// robot's reach) the margins around are doubled. Iterates are judged as well,
// and the first that is free ends it: what is shorter path_descent.h finds from
// there.  It also ends where rounds or time are up, or Ipopt has given up
// max_failures times in a row.
PoseRoundsEnd FreePoses(const RigidModel& model,
                        const std::vector<RobotPose>& start,
                        const PoseRoundsTask& task, PoseRows* rows,
                        RigidStop* stop);

}  // namespace phongpd::internal
