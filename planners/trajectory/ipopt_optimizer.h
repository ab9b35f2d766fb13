// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "constraints/non_penetration.h"
#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/path_history.h"
#include "planners/trajectory/trajectory_problem.h"

namespace phongpd {

struct TrajectoryOptions {
  // The settings of each round; time_limit is for all rounds together.
  IpoptSettings ipopt;
  // K rows for each sample, 1 to 8.  In a single solve, more rows hold the
  // path better in thin and narrow places; but there they contradict each other
  // if the start collides.  For the pipeline, which judges and polishes, one
  // row is as good and faster (results/trade/defaults.md).
  int rows = 1;
  // The largest number of solves, ≥ 1.  After a round whose path collides, the
  // segments that collide get twice the samples, and the next round starts from
  // that path.  This is done if the solver claims a solution or ran out of
  // iterations; and also if it ended infeasible or in numerical trouble,
  // because a new start near the old end finds a way out of some traps.
  int max_rounds = 4;

  // Throws InputError naming the field.
  void Validate() const;
};

// The path that a solve found, with evidence.  No member is NaN or infinite.
struct TrajectorySummary {
  SolveStatus status = SolveStatus::kInvalidProblem;  // of the last round
  // Ipopt's own name of the status; empty if Ipopt did not run, because there
  // was nothing to do or an end was not free.
  std::string raw_status;
  Path path;  // N+2 points, start and goal included

  bool collision_free = false;  // always the exact judgement of `path`
  PathCheck first_crossing;     // if not free: where it collides first
  double objective = 0.0;       // energy of `path`
  double violation = 0.0;  // inf_pr: largest of any row at `path`, units of D
  double dual_infeasibility = -1.0;  // inf_du; −1: not known
  std::vector<int> samples;          // of each segment, in the last round

  int rounds = 0;
  int iterations = 0;  // all rounds
  int restoration_iterations = 0;
  EvaluationCounts evaluations;
  NonPenetrationCounts queries;
  double seconds_callbacks = 0.0;
  double seconds_total = 0.0;
  std::vector<IterationRecord> log;  // all rounds, numbered through

  // The solver claims a solution (IsClassOk), the path is judged free, and its
  // objective is finite.
  bool IsSolved() const;
};

// Optimises a path with Ipopt, in rounds.  The solver's claim is never enough:
// `collision_free` is the exact judgement.  The same input gives the same
// result, bit for bit.  TrajectoryPipeline adds free starts and the corridor.
class IpoptTrajectoryOptimizer {
 public:
  // Throws InputError for a bad problem or bad options, also for options of
  // Ipopt that it does not know.
  explicit IpoptTrajectoryOptimizer(const TrajectoryProblem& problem,
                                    const TrajectoryOptions& options = {});

  // Starts from a path of N+2 points from start to goal, which may collide.
  // Throws InputError for another shape.  The status is kInvalidStart or
  // kInvalidGoal if that end is not free.  Solves run one at a time in a
  // process (SolveWithIpopt).  on_path is called with every iterate of every
  // round.
  TrajectorySummary Solve(const Path& start_path,
                          const PathObserver& on_path = {}) const;
  // Starts from the straight line.
  TrajectorySummary Solve() const { return Solve(StraightPath(problem_)); }

  const TrajectoryProblem& problem() const { return problem_; }

 private:
  TrajectoryProblem problem_;
  TrajectoryOptions options_;
};

}  // namespace phongpd
