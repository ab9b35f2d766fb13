// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "planners/exact/start_repair.h"
#include "planners/trajectory/corridor.h"
#include "planners/trajectory/ipopt_optimizer.h"
#include "planners/trajectory/trajectory_problem.h"
#include "planners/world/path_status.h"
#include "planners/world/preset.h"

namespace phongpd {

// What the first solve starts from.
enum class TrajectoryStart {
  kStraight,  // the line, colliding or not: for comparisons
  kRepaired,  // the line where it is free, a planned path where it collides
              // (start_repair.h)
};

enum class PolishWhen {
  kNever,
  kNeeded,  // when Ipopt did not converge to an exactly free path that keeps
            // its margin between the samples, too
  kAlways,  // also then: full margins, the best objective
};

struct PipelineOptions {
  TrajectoryStart start = TrajectoryStart::kRepaired;
  // kStraight: standard deviation of every coordinate of the free waypoints,
  // fraction of |goal − start|, ≥ 0.
  double start_noise = 0.0;
  int routes = 1;  // ways around the obstacles to optimise, in [1, 8]
  // kRepaired: optimise from the colliding line as well, and keep the better
  // path.  The line ends in another valley now and then; that costs a second
  // solve by Ipopt, of at most 100 iterations, which is given up ("no_gain")
  // once its nearly feasible iterates fall too slowly to gain 0.2 %.
  bool also_line = true;
  PolishWhen polish = PolishWhen::kNeeded;
  TrajectoryOptions optimizer;
  std::uint64_t seed = 1;  // of straightening and noise
  double time_limit = std::numeric_limits<double>::infinity();  // seconds
  // Told of every iterate of every stage.
  PathObserver on_path;

  // Throws InputError naming the field.
  void Validate() const;
};

// One step of the pipeline.
struct StageRecord {
  std::string stage;     // "start", "ipopt", "corridor"
  int route = 0;         // 0: the shortest; the line comes last
  std::string status;    // in the words of the stage
  bool is_free = false;  // the exact judge's word on what it returned
  double objective = 0.0;
  int iterations = 0;  // of Ipopt
  double seconds = 0.0;
};

// No member is NaN or infinite.
struct PipelineResult {
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // where the status needs one; one sentence
  Path path;           // N+2 points; empty without any
  // Evidence: the judge's word on `path`, free or the first crossing.
  PathCheck certificate;
  double objective = 0.0;  // energy of `path`
  // MissingClearance of `path` if it is free (corridor.h), else 0.
  double missing_clearance = 0.0;
  int route = 0;       // that was best
  int iterations = 0;  // of Ipopt, all stages
  int restoration_iterations = 0;
  StartRepairResult repair;  // kStraight: nothing was done
  TrajectorySummary ipopt;   // of the best route; no path if it did not run
  std::vector<StageRecord> stages;
  double seconds_callbacks = 0.0;  // of Ipopt, all routes, corridor apart
  double seconds = 0.0;
};

// What pipelines do alike, those of one's own as well.
//
// Are start and goal free?  Otherwise result->status says which is not.
bool CheckEnds(const TrajectoryProblem& problem, PipelineResult* result);
// The observer with the stage and route that iterates belong to; none for none.
PathObserver OfStage(const PathObserver& observer, const std::string& stage,
                     int route);
// Adds a step that gave `path`: its is_free and objective are the judge's word
// and the energy of that, and its iterations count in the result's.
void AddStage(const TrajectoryProblem& problem, const Path& path,
              StageRecord stage, PipelineResult* result);

// Whoever finds the free ways that kRepaired starts from instead of
// StartRepair, and answers as that does.
struct OwnStarts {
  std::function<StartRepairResult(const StartRepairOptions& wished)> find;
};

// The default way to a trajectory:
//
//   start → Ipopt → exact judge → corridor where that is needed → exact judge
//
// for each route; of the exactly free paths the best one wins, clearance first
// (MissingClearance), then the objective.  The corridor starts from Ipopt's
// path where that is free and better than the start, otherwise from the start,
// also where Ipopt left it for another valley: its path costs more than a start
// that keeps clear, or a tenth more than one that does not.  Such a path is
// kept for the case that the corridor gains no clearance.  The corridor follows
// the first round already, and Ipopt is skipped where a free start has less
// than half the margin (passages narrower than it), because its program is
// mostly infeasible there.  Where repair fails without a proof Ipopt is tried
// from the colliding line.
//
// Lengths are relative to D and positions to the middle of start and goal, so
// that unit and offset do not matter.  Same arguments, same bytes but for
// seconds.
class TrajectoryPipeline {
 public:
  // `repair` of the boundary of the union of all contact spaces and bounds of
  // the problem; null only for kStraight.  Throws InputError for options and
  // problems that IpoptTrajectoryOptimizer would refuse.
  TrajectoryPipeline(const TrajectoryProblem& problem,
                     std::shared_ptr<const StartRepair> repair,
                     const PipelineOptions& options = {});

  TrajectoryPipeline(const TrajectoryProblem& problem, const OwnStarts& starts,
                     const PipelineOptions& options = {});

  // One solve at a time in a process (SolveWithIpopt).
  PipelineResult Solve() const;

 private:
  TrajectoryProblem problem_;
  OwnStarts starts_;
  PipelineOptions options_;
};

}  // namespace phongpd
