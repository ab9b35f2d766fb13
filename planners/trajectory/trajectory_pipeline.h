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

// The path that the first solve starts from.
enum class TrajectoryStart {
  kStraight,  // the straight line, even if it collides: for comparisons
  kRepaired,  // the straight line with a planned path in place of the parts
              // that collide (start_repair.h)
};

// When is the path polished in a corridor (corridor.h)?
enum class PolishWhen {
  kNever,
  kNeeded,  // unless Ipopt converged to a free path that keeps its margin
            // everywhere, not only at the samples
  kAlways,  // always: for full margins and the best objective
};

struct PipelineOptions {
  TrajectoryStart start = TrajectoryStart::kRepaired;
  // kStraight: noise on every coordinate of the free waypoints; its standard
  // deviation as a fraction of |goal − start|, ≥ 0.
  double start_noise = 0.0;
  int routes = 1;  // routes around the obstacles to optimise, in [1, 8]
  // kRepaired: also optimise from the colliding straight line, and keep the
  // better path.  The line sometimes leads to a better local minimum.  It takes
  // a second solve by Ipopt, of at most 100 iterations; this is stopped
  // ("no_gain") when its nearly feasible iterates fall too slowly to gain
  // 0.2 %.
  bool also_line = true;
  PolishWhen polish = PolishWhen::kNeeded;
  TrajectoryOptions optimizer;
  std::uint64_t seed = 1;  // of all random numbers: shortening and noise
  double time_limit = std::numeric_limits<double>::infinity();  // seconds
  // Called with every iterate of every stage.
  PathObserver on_path;

  // Throws InputError naming the field.
  void Validate() const;
};

// One stage of the pipeline.
struct StageRecord {
  std::string stage;       // "start", "ipopt", "corridor"
  int route = 0;           // 0: the shortest route; the straight line is last
  std::string status;      // in the words of the stage
  bool is_free = false;    // the exact judgement of the path it gave
  double objective = 0.0;  // energy of that path
  int iterations = 0;      // of Ipopt
  double seconds = 0.0;
};

// What one route came to.
struct RouteResult {
  PathStatus status = PathStatus::kFailed;
  std::string reason;  // one sentence, if the status needs one
  Path path;           // N+2 points, start and goal included; empty: no path
  double objective = 0.0;  // energy of `path` (trajectory_problem.h)
  // MissingClearance of `path` if it is free (corridor.h), else 0.
  double missing_clearance = 0.0;
  int route = 0;            // the route that `path` belongs to
  TrajectorySummary ipopt;  // no path if it did not run
};

// What the best route came to, and all stages.  No member is NaN or infinite.
struct PipelineResult : RouteResult {
  // The exact judgement of `path`: free, or where it collides first.
  PathCheck certificate;
  int iterations = 0;  // of Ipopt, all stages
  int restoration_iterations = 0;
  StartRepairResult repair;  // empty for kStraight
  std::vector<StageRecord> stages;
  double seconds_callbacks = 0.0;  // in Ipopt's callbacks, but the corridor's
  double seconds = 0.0;            // wall time
};

// Building blocks for a pipeline of your own.
//
// Are start and goal free?  If not, result->status says which one is not.
bool CheckEnds(const TrajectoryProblem& problem, PipelineResult* result);
// The observer that passes on iterates with this stage and route; an empty one
// for an empty one.
PathObserver OfStage(const PathObserver& observer, const std::string& stage,
                     int route);
// Adds a stage that gave `path` to the result.  Sets its is_free and objective
// by judging the path, and adds its iterations to the result's.
void AddStage(const TrajectoryProblem& problem, const Path& path,
              StageRecord stage, PipelineResult* result);

// A function that finds free start paths in place of StartRepair.
struct OwnStarts {
  std::function<StartRepairResult(const StartRepairOptions& wished)> find;
};

// The default way to an optimised path of a robot that translates:
//
//   start → Ipopt → exact judge → corridor if needed → exact judge
//
// for each route.  Of the free paths, one that keeps its clearance
// (MissingClearance, kToleratedMissing) is better than one that does not; then
// the lower objective is.  Optimize of planners/solve/optimize.h does all this
// for a World; use the pipeline to set its options one by one.
//
// The corridor starts from Ipopt's path if this is free and better than the
// start path, otherwise from the start path.  Ipopt's path also counts as worse
// if it costs more than a start that keeps its clearance, or a tenth more than
// one that does not: Ipopt then went to another local minimum.  Its path is
// kept in case the corridor gains no clearance.  Before a corridor Ipopt gets
// one round only; it is skipped if a free start has less than half the margin,
// because its program is mostly infeasible in such narrow passages.  If repair
// fails without a proof, Ipopt starts from the colliding line.
//
// Lengths are computed relative to D, and positions relative to the middle of
// start and goal: unit and offset do not matter.  The same arguments give the
// same result, bit for bit, except for seconds.
class TrajectoryPipeline {
 public:
  // `repair` is made of one contact space of all obstacles and bounds of the
  // problem; it may be null for kStraight only.  Throws InputError for options,
  // and for problems that IpoptTrajectoryOptimizer would refuse.
  TrajectoryPipeline(const TrajectoryProblem& problem,
                     std::shared_ptr<const StartRepair> repair,
                     const PipelineOptions& options = {});

  // The same with starts repaired in the world that the problem was made of.
  TrajectoryPipeline(const World& world, const TrajectoryProblem& problem,
                     const PipelineOptions& options = {});

  TrajectoryPipeline(const TrajectoryProblem& problem, const OwnStarts& starts,
                     const PipelineOptions& options = {});

  // Solves run one at a time in a process (SolveWithIpopt).
  PipelineResult Solve() const;

 private:
  TrajectoryProblem problem_;
  OwnStarts starts_;
  PipelineOptions options_;
};

}  // namespace phongpd
