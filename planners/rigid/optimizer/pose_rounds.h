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
  // Rounds in a row that Ipopt does not call solved, as long as no free path is
  // known.
  int max_failures = 3;
  double time_limit = 0.0;  // seconds of all rounds
};

struct PoseRoundsEnd {
  // The shortest iterate with every link proved free; empty: none.
  std::vector<RobotPose> path;
  double length = 0.0;  // its, object norm
  // Ipopt's word on the last round, and whether the judge confirms what it
  // calls solved.
  SolveStatus status = SolveStatus::kInvalidProblem;
  bool is_confirmed = false;
  bool was_refuted = false;  // once at least it did not
  int rounds = 0, iterations = 0;
  std::size_t samples = 0, added_samples = 0;
  long checks = 0, tests = 0;  // of the judge
};

// Optimises a path of three poses or more, whose ends stay, free or not.  Each
// round is a solve of PoseProgram with samples at the middle and the end of
// each link, around the poses of the round before.  Then each part between two
// samples is judged for all of its t.  Where it is not free it gets a sample
// where it was seen to collide, or is not decided, whose margin is doubled with
// each round that added some to the link before; where two samples are close
// already (kLeastPart of the robot's reach) the margins around are doubled.
// Once a free path is known rounds begin at free paths: what was refuted is
// drawn back towards it.  Ends when the judge confirms what Ipopt calls solved,
// or rounds or time are up, or Ipopt has given up max_failures times
// in a row, three times once a free path is known.
PoseRoundsEnd OptimizePoses(const RigidModel& model,
                            const std::vector<RobotPose>& start,
                            const PoseRoundsTask& task, PoseRows* rows,
                            RigidStop* stop);

}  // namespace phongpd::internal
