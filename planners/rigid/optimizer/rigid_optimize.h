// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "planners/rigid/rigid_plan.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd {

// Where the optimiser begins.
enum class RigidStart {
  kBoth,      // the straight motion; where that ends without a proved path, the
              // planner's
  kStraight,  // the straight motion alone, through what is in its way
  kPlanner,   // the path of Plan alone
};

const char* ToString(RigidStart start);  // both, straight, planner
// Throws InputError "<what>: …" for another word.
RigidStart ParseRigidStart(const std::string& text, const std::string& what);

// A short path of poses from start to goal.
struct RigidOptimizeRequest {
  // Start, goal, bounds, seed, and the time of all: a third of it at most goes
  // into freeing the straight motion, nine tenths of what is left into the
  // planner.
  RigidRequest task;
  RigidStart from = RigidStart::kBoth;
  int knots = 8;  // poses between the ends, at least; in [1, 200]
  // Clearance asked for at the samples, user's unit, [0, reach]; 0: a
  // thousandth of the robot's reach.  What is proved is free, not the margin.
  double margin = 0.0;
  // The straight motion's knots are moved at random, by a normal deviate of
  // this share of its length in the object norm; [0, 1].
  double start_noise = 0.0;
  // By TrackedPoseRow, else PoseRow, while they collide.
  bool is_tracked = false;
  // Solves until a path is free, and as many from there, [1, 100].
  int max_rounds = 100;

  // Throws InputError naming the field.
  void Validate() const;
};

// What Optimize answers.  No member is NaN or infinite.
struct RigidOptimum {
  // As of Plan, with these words.  status: kSolved, Ipopt converged to the path
  // (or it is the straight motion, which nothing beats); kStalledFeasible, it
  // did not, and the path is the shortest free one that was seen; kFailed,
  // kTimeLimit: none.  planner: "line", "straight" or "planner", by the start
  // that led to it, or that of Plan's path where nothing shorter was found
  // ("slide").  Every motion of a path is proved free for all t, twice,
  // whatever the status; and none is longer than Plan's, where that was asked.
  RigidAnswer answer;
  // kConverged: no small step of the knots shortens the path, to first order
  // (to 1e-4 of its length).  kStalledFeasible: steps that should were refused,
  // down to small ones.  Else what ended it; of a straight motion that was not
  // freed Ipopt's word on the last round.
  SolveStatus solver = SolveStatus::kInvalidProblem;
  // What Ipopt called solved was proved free, once at least.
  bool is_confirmed = false;
  // At least once the judge refuted what Ipopt called solved.
  bool was_refuted = false;
  double planned_length = 0.0;     // of Plan's path, shortened; 0: not asked
  int rounds = 0, iterations = 0;  // of all starts
  std::size_t samples = 0;         // in the last round
  std::size_t added_samples = 0;   // of all rounds, where the judge asked
};

// Optimises the length of a path in the object norm (rigid_world.h) with Ipopt,
// and proves it free for all t; a claim of the solver is never enough.
//
// Where the start collides, rounds on exact depth and gaps at samples free it:
// motions between samples are judged (RigidJudge), and where one is not free a
// sample is added there and the program solved again.  From the first free
// path, or from the planner's, it descends: each step is a program linear in
// all contacts within reach, and is taken only if the judge proves the whole
// path.  So from then on there is a proved path at any moment, and a run that
// is ended has an answer, too.
//
// A local optimum, of the way around things that its start took.  Where robot
// or obstacles are no solids there is no depth: what collides is no iterate
// then, and the straight motion no start.
//
// Throws InputError for bad requests.  One solve at a time in a process
// (SolveWithIpopt); the same request gives the same path on the same machine
// unless time runs out.
RigidOptimum Optimize(const RigidWorld& world,
                      const RigidOptimizeRequest& request);

}  // namespace phongpd
