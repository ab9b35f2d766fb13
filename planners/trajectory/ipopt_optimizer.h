// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "constraints/non_penetration.h"
#include "planners/trajectory/ipopt_solve.h"
#include "planners/trajectory/path_history.h"
#include "planners/trajectory/trajectory_problem.h"

namespace phongpd {

struct TrajectoryOptions {
  // A round's iterations, tolerance, strategy and stops; time_limit is for all
  // rounds together.
  IpoptSettings ipopt;
  // K rows a sample, 1 to 8.  More hold thin and narrow parts better in one
  // solve, and contradict each other there where the start collides; the
  // pipeline, which judges and polishes, is as good with one in less time
  // (results/trade/defaults.md).
  int rows = 1;
  // Solves, ≥ 1.  Where the solver claims a solution, or ran out of iterations,
  // and the judge finds a crossing, the segments that cross get twice the
  // samples and the next round starts from there; also after rounds that ended
  // infeasible or in numerical trouble, where a new start near the old end
  // finds a way out of some traps.
  int max_rounds = 4;

  // Throws InputError naming the field.
  void Validate() const;
};

// What a solve found, with its evidence.  No member is NaN or infinite.
struct TrajectorySummary {
  SolveStatus status = SolveStatus::kInvalidProblem;  // of the last round
  // Ipopt's own name for it; empty where Ipopt had nothing to do or the ends
  // were invalid.
  std::string raw_status;
  Path path;  // N+2 points, start and goal included

  bool collision_free = false;  // the exact judge's word on `path`, always
  PathCheck first_crossing;     // where it is not
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

  // Solver class ok, judged free, objective finite.
  bool IsSolved() const;
};

// Optimises trajectories with Ipopt.  A claim of the solver is never enough:
// `collision_free` is the exact judge's.  Same input, same bytes.
class IpoptTrajectoryOptimizer {
 public:
  // Throws InputError for a bad problem or options, misspelt Ipopt options
  // included.
  explicit IpoptTrajectoryOptimizer(const TrajectoryProblem& problem,
                                    const TrajectoryOptions& options = {});

  // From a path of N+2 points that begins at start and ends at goal; it may
  // collide.  Throws InputError for another shape.  kInvalidStart or
  // kInvalidGoal where the judge refuses an end.  One solve at a time in a
  // process (SolveWithIpopt).  on_path is told of every iterate of every round.
  TrajectorySummary Solve(const Path& start_path,
                          const PathObserver& on_path = {}) const;
  // From the straight line.
  TrajectorySummary Solve() const { return Solve(StraightPath(problem_)); }

  const TrajectoryProblem& problem() const { return problem_; }

 private:
  TrajectoryProblem problem_;
  TrajectoryOptions options_;
};

}  // namespace phongpd
