// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "planners/rigid/rigid_plan.h"
#include "planners/trajectory/ipopt_solve.h"

namespace phongpd {

// Which path the optimiser starts from.
enum class RigidStart {
  kBoth,      // the straight motion; if no proved path comes of it, the path
              // that Plan finds
  kStraight,  // the straight motion only, even if it collides
  kPlanner,   // the path that Plan finds only
};

const char* ToString(RigidStart start);  // both, straight, planner
// The reverse of ToString.  Throws InputError "<what>: …" for other words.
RigidStart ParseRigidStart(const std::string& text, const std::string& what);

// What Optimize is asked: a short path of poses from start to goal.
struct RigidOptimizeRequest {
  // Start, goal, bounds, seed, Plan's threads, and the time limit of the whole
  // call.  A third of it at most goes into freeing the straight motion, nine
  // tenths of what is left into Plan.
  RigidRequest task;
  RigidStart from = RigidStart::kBoth;
  int knots = 8;  // least number of poses between start and goal, in [1, 200]
  // The clearance that the rows ask for at the samples, user's unit, ≥ 0; 0: a
  // thousandth of the robot's reach.  The answer is proved free, but not to
  // keep this margin.
  double margin = 0.0;
  // Noise on the straight motion's knots: the standard deviation, as a share in
  // [0, 1] of that motion's length in the object norm.
  double start_noise = 0.0;
  // The rows of colliding samples: TrackedPoseRow if true, PoseRow if false.
  bool is_tracked = false;
  // Most solves until a path is free, and as many from there on, in [1, 100].
  int max_rounds = 100;

  // Throws InputError naming the field.
  void Validate() const;
};

// What Optimize answers.  No member is NaN or infinite.
struct RigidOptimum {
  // Like Plan's answer.  Whatever the status, every motion of a path is proved
  // free for all t, twice; and if Plan was asked, no path is longer than
  // Plan's.
  //   status  kSolved: converged, or the straight motion is free, and nothing
  //   is
  //           shorter.  kStalledFeasible: it did not; this is the shortest free
  //           path that was seen.  kFailed, kTimeLimit, …: there is no path.
  //   planner "line": the straight motion as it is.  "straight", "planner": the
  //           start it was optimised from.  "slide" and others: Plan's path, of
  //           that planner, because nothing shorter was found.
  RigidAnswer answer;
  // kConverged: no small step of the knots shortens the path, to first order
  // (to 1e-4 of its length).  kStalledFeasible: steps that should shorten it
  // were refused, down to small ones.  Else what ended it; if the straight
  // motion could not be freed, how Ipopt ended in the last round.
  SolveStatus solver = SolveStatus::kInvalidProblem;
  // What Ipopt called solved was proved free, at least once.
  bool is_confirmed = false;
  // At least once the judge refuted a path that Ipopt called solved.
  bool was_refuted = false;
  double planned_length = 0.0;     // of Plan's path, shortened; 0: none
  int rounds = 0, iterations = 0;  // from all starts together
  std::size_t samples = 0;         // in the last round
  std::size_t added_samples = 0;   // because of the judge, in all rounds
};

// Makes a path of a robot that translates and turns short, in the object norm
// (rigid_world.h), with Ipopt, and proves it free for all t; the solver's claim
// is never enough.  For a robot that only translates use planners/solve/
// optimize.h.
//
// If the straight motion collides, rounds free it: Ipopt solves with rows on
// exact depths and gaps at samples of the path; RigidJudge judges the motions
// between samples, and where one is not free a sample is added.  From the first
// free path, or from Plan's, the optimiser descends: each step is a program
// that is linear in all contacts within reach, and is taken only if the judge
// proves the whole path free.  So there is a proved path at any moment from
// then on, and a run that is ended has an answer, too.
//
// The result is a local optimum: it passes obstacles on the side on which its
// start does.  If the robot or the obstacles are no solids, a collision has no
// depth; then the straight motion cannot be a start.
//
// Throws InputError for bad requests.  One solve at a time in a process
// (SolveWithIpopt).  The same request gives the same path on the same machine
// unless time runs out.
RigidOptimum Optimize(const RigidWorld& world,
                      const RigidOptimizeRequest& request);

}  // namespace phongpd
