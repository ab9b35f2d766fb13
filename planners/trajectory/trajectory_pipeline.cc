// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/trajectory_pipeline.h"

#include <algorithm>
#include <random>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/no_gain.h"
#include "planners/world/world.h"

namespace phongpd {
namespace {

// Of Ipopt from the colliding line, where there is a repaired start as well.
// Most that arrive take half as many.
constexpr int kLineIterations = 100;

// Of the objective: a smaller gain is worth no search, and no other status.
constexpr double kWorthwhile = 2e-3;

// A path that keeps clear has a few percent more than a start that does not;
// one that has this much more took another way around.
constexpr double kOtherValley = 1.1;

// A path in hand and what is known of it.
struct Candidate : RouteResult {
  bool is_given_up = false;  // a better one is in hand

  bool IsFree() const { return HasFreePath(status); }
  bool KeepsClear() const { return missing_clearance <= kToleratedMissing; }

  bool IsBetterThan(const Candidate& other) const {
    if (IsFree() != other.IsFree()) return IsFree();
    if (KeepsClear() != other.KeepsClear()) return KeepsClear();
    return objective < other.objective;
  }
};

// One run of the pipeline.
class Run {
 public:
  Run(const TrajectoryProblem& problem, const OwnStarts& starts,
      const PipelineOptions& options)
      : problem_(problem), starts_(starts), options_(options) {}

  PipelineResult Solve() {
    std::vector<Path> starts;
    if (CheckEnds(problem_, &result_) && FindStarts(&starts)) {
      for (std::size_t i = 0; i < starts.size(); ++i) {
        Candidate found = SolveRoute(starts[i], static_cast<int>(i));
        const bool is_better = !found.is_given_up && found.IsBetterThan(best_);
        if (i == 0 || is_better) best_ = std::move(found);
      }
      if (options_.also_line && WantsLine(starts[0])) {
        const int route = static_cast<int>(starts.size());
        const Path line = StraightPath(problem_);
        Note({"start", route, "straight", false, 0.0, 0, 0.0}, line);
        Candidate found = SolveRoute(line, route);
        if (!found.is_given_up && found.IsBetterThan(best_)) {
          best_ = std::move(found);
        }
      }
      static_cast<RouteResult&>(result_) = std::move(best_);
    }
    result_.certificate = CheckPath(*problem_.free_space, result_.path);
    result_.seconds = stopwatch_.Seconds();
    return std::move(result_);
  }

 private:
  double Left() const {
    return std::max(1e-3, options_.time_limit - stopwatch_.Seconds());
  }
  bool IsLate() const { return stopwatch_.Seconds() >= options_.time_limit; }

  void Note(StageRecord record, const Path& path) {
    AddStage(problem_, path, std::move(record), &result_);
  }

  Path NoisyLine() const {
    Path path = StraightPath(problem_);
    if (options_.start_noise == 0.0) return path;
    std::mt19937_64 random(options_.seed);
    std::normal_distribution<double> normal;
    const double size =
        options_.start_noise * (problem_.goal - problem_.start).norm();
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      for (double& x : path[i]) x += size * normal(random);
    }
    return path;
  }

  // False: the answer is known already.
  bool FindStarts(std::vector<Path>* starts) {
    if (options_.start != TrajectoryStart::kStraight) {
      StartRepairOptions repair;
      repair.waypoints = problem_.waypoints;
      // A path along the surface itself is no start.
      repair.clearance = std::max(problem_.margin, 1e-6) * Diagonal(problem_);
      repair.routes = options_.routes;
      repair.seed = options_.seed;
      result_.repair = starts_.find(repair);
      *starts = result_.repair.routes;
    }
    const PathStatus status = result_.repair.status;
    if (status == PathStatus::kInfeasibleProved) {
      result_.status = PathStatus::kInfeasibleProved;
      result_.reason = result_.repair.reason;
    } else if (starts->empty()) {
      starts->push_back(NoisyLine());
    }
    const bool is_straight = options_.start == TrajectoryStart::kStraight;
    for (std::size_t i = 0; i < starts->size(); ++i) {
      Note({"start", static_cast<int>(i),
            is_straight ? "straight" : ToString(status), false, 0.0, 0,
            i == 0 ? result_.repair.seconds : 0.0},
           (*starts)[i]);
    }
    return status != PathStatus::kInfeasibleProved;
  }

  Candidate SolveRoute(const Path& start, int route) {
    Candidate candidate, aside;
    candidate.route = route;
    Keep(start, &candidate);
    if (candidate.IsFree()) {
      candidate.reason = "the time limit came before the optimiser";
    }
    const bool may_polish =
        options_.polish != PolishWhen::kNever && candidate.IsFree();
    if (may_polish && IsTooNarrow(start)) {
      candidate.reason = "the start has too little clearance for Ipopt's rows";
      Note({"ipopt", route, "skipped", false, 0.0, 0, 0.0}, start);
    } else if (!IsLate()) {
      Optimize(start, may_polish, &candidate, &aside);
    }
    const bool is_wanted =
        options_.polish == PolishWhen::kAlways ||
        (options_.polish == PolishWhen::kNeeded &&
         (candidate.status != PathStatus::kSolved || !candidate.KeepsClear()));
    if (is_wanted && candidate.IsFree() && !candidate.is_given_up &&
        !IsLate()) {
      Polish(&candidate);
    }
    const bool lacks_clearance = aside.IsFree() && !candidate.KeepsClear();
    return lacks_clearance && aside.IsBetterThan(candidate) ? aside : candidate;
  }

  // A repaired path keeps to the middle of passages.  Where it has less than
  // half the margin Ipopt's program is mostly infeasible, and it takes hundreds
  // of iterations to find out.
  bool IsTooNarrow(const Path& start) const {
    const double margin = problem_.margin * Diagonal(problem_);
    return margin > 0.0 &&
           PathClearance(*problem_.free_space, start) < 0.5 * margin;
  }

  // The line finds no way through a passage too narrow for Ipopt's rows; it
  // may find a wider one.
  bool WantsLine(const Path& start) const {
    return result_.repair.status == PathStatus::kRepaired && !IsLate() &&
           (!IsTooNarrow(start) || !best_.KeepsClear());
  }

  // Makes the path the candidate, as free or not free, not converged.
  void Keep(const Path& path, Candidate* candidate) {
    candidate->status = CheckPath(*problem_.free_space, path).free
                            ? PathStatus::kStalledFeasible
                            : PathStatus::kFailed;
    candidate->path = path;
    candidate->objective = PathEnergy(problem_, path);
    candidate->missing_clearance =
        candidate->IsFree() ? MissingClearance(problem_, path) : 0.0;
  }

  // Of Ipopt for one route; the line is what collides although another route
  // is in hand.
  TrajectoryOptions Settings(const Candidate& candidate,
                             bool may_polish) const {
    TrajectoryOptions options = options_.optimizer;
    if (may_polish) {
      // With a free start in hand the corridor is the better second round, and
      // Mehrotra's step, bold for Ipopt's usual rule of mu, wins time.
      options.max_rounds = 1;
      options.ipopt.ipopt_options.emplace("mu_oracle", "probing");
    }
    // With another route in hand no long search is worth its time.
    if (candidate.route > 0 && !candidate.IsFree()) {
      options.max_rounds = 1;
      options.ipopt.max_iterations =
          std::min(options.ipopt.max_iterations, kLineIterations);
    }
    options.ipopt.time_limit = std::min(options.ipopt.time_limit, Left());
    return options;
  }

  // `aside`: what it found, where the start is the better thing to polish.
  void Optimize(const Path& start, bool may_polish, Candidate* candidate,
                Candidate* aside) {
    TrajectoryOptions options = Settings(*candidate, may_polish);
    NoGain no_gain(best_.objective, kWorthwhile);
    const bool is_second = candidate->route > 0 && !candidate->IsFree() &&
                           best_.IsFree() && best_.KeepsClear();
    if (is_second && options_.polish != PolishWhen::kNever) {
      no_gain.Stop(&options.ipopt);
    }
    candidate->ipopt =
        IpoptTrajectoryOptimizer(problem_, options)
            .Solve(start, OfStage(options_.on_path, "ipopt", candidate->route));
    const TrajectorySummary& summary = candidate->ipopt;
    candidate->is_given_up =
        summary.status == SolveStatus::kCancelled && no_gain.has_ended();
    const std::string word =
        candidate->is_given_up ? "no_gain" : ToString(summary.status);
    result_.restoration_iterations += summary.restoration_iterations;
    result_.seconds_callbacks += summary.seconds_callbacks;
    Note({"ipopt", candidate->route, word, false, 0.0, summary.iterations,
          summary.seconds_total},
         summary.path);
    Candidate found;
    found.route = candidate->route;
    found.is_given_up = candidate->is_given_up;
    found.ipopt = summary;
    Keep(summary.path, &found);
    const bool is_converged = summary.status == SolveStatus::kConverged ||
                              summary.status == SolveStatus::kAcceptable;
    // Ipopt may leave a start for a worse valley; the corridor never does.
    const double allowed =
        candidate->KeepsClear() ? 1.0 / (1.0 - kWorthwhile) : kOtherValley;
    const bool is_worse = may_polish && found.IsFree() &&
                          found.objective > allowed * candidate->objective;
    if (found.IsFree() && is_converged && !is_worse) {
      found.status = PathStatus::kSolved;
      *candidate = std::move(found);
      return;
    }
    const std::string reason =
        is_converged && is_worse
            ? "Ipopt converged to a worse path than its start"
            : "Ipopt ended " + word +
                  (found.IsFree() ? "" : ", its path collides");
    // A start that collides is no better than an end that does.
    if (is_worse) {
      *aside = std::move(found);
      aside->reason = reason;
      if (is_converged) {
        aside->status = PathStatus::kSolved;
        aside->reason.clear();
      }
    } else if (!candidate->IsFree() || found.IsBetterThan(*candidate)) {
      *candidate = std::move(found);
    }
    candidate->reason = reason;
  }

  void Polish(Candidate* candidate) {
    CorridorSummary summary = PolishInCorridor(
        problem_, candidate->path, Left(),
        OfStage(options_.on_path, "corridor", candidate->route));
    Note({"corridor", candidate->route, ToString(summary.status), false, 0.0,
          summary.iterations, summary.seconds},
         summary.path);
    candidate->path = std::move(summary.path);
    candidate->objective = summary.objective;
    candidate->missing_clearance = MissingClearance(problem_, candidate->path);
    if (summary.HasConverged()) {
      candidate->status = PathStatus::kPolished;
      candidate->reason.clear();
    } else if (candidate->status != PathStatus::kSolved) {
      candidate->reason +=
          std::string(", the corridor ") + ToString(summary.status);
    }
  }

  const TrajectoryProblem& problem_;
  const OwnStarts& starts_;
  const PipelineOptions& options_;
  Stopwatch stopwatch_;
  Candidate best_;
  PipelineResult result_;
};

}  // namespace

void PipelineOptions::Validate() const {
  const auto check = [](bool holds, const char* name, const char* range,
                        auto value) {
    CheckOption(holds, "trajectory", name, range, value);
  };
  check(routes >= 1 && routes <= 8, "routes", "1 to 8", routes);
  check(start_noise >= 0.0 && start_noise <= 10.0, "start_noise", "0 to 10",
        start_noise);
  check(time_limit > 0.0, "time_limit", "> 0 seconds", time_limit);
  optimizer.Validate();
}

bool CheckEnds(const TrajectoryProblem& problem, PipelineResult* result) {
  const FreeSpace& space = *problem.free_space;
  if (!space.IsFree(problem.start)) {
    result->status = PathStatus::kStartInCollision;
  } else if (!space.IsFree(problem.goal)) {
    result->status = PathStatus::kGoalInCollision;
  } else {
    return true;
  }
  return false;
}

PathObserver OfStage(const PathObserver& observer, const std::string& stage,
                     int route) {
  if (!observer) return {};
  return [observer, stage, route](const PathIterate& iterate) {
    PathIterate told = iterate;
    told.stage = stage;
    told.route = route;
    observer(told);
  };
}

void AddStage(const TrajectoryProblem& problem, const Path& path,
              StageRecord stage, PipelineResult* result) {
  stage.is_free = CheckPath(*problem.free_space, path).free;
  stage.objective = PathEnergy(problem, path);
  result->iterations += stage.iterations;
  result->stages.push_back(std::move(stage));
}

TrajectoryPipeline::TrajectoryPipeline(
    const TrajectoryProblem& problem, std::shared_ptr<const StartRepair> repair,
    const PipelineOptions& options)
    : TrajectoryPipeline(
          problem,
          repair == nullptr
              ? OwnStarts{}
              : OwnStarts{[repair, start = problem.start, goal = problem.goal](
                              const StartRepairOptions& wished) {
                  return repair->Repair(start, goal, wished);
                }},
          options) {}

TrajectoryPipeline::TrajectoryPipeline(const World& world,
                                       const TrajectoryProblem& problem,
                                       const PipelineOptions& options)
    : TrajectoryPipeline(problem, std::make_shared<StartRepair>(world.Sealed()),
                         options) {}

TrajectoryPipeline::TrajectoryPipeline(const TrajectoryProblem& problem,
                                       const OwnStarts& starts,
                                       const PipelineOptions& options)
    : problem_(problem), starts_(starts), options_(options) {
  problem_.Validate();
  options_.Validate();
  CheckIpoptOptions(options_.optimizer.ipopt);
  if (!starts_.find && options_.start != TrajectoryStart::kStraight) {
    throw InputError(
        "trajectory: start: only a straight one goes without start repair");
  }
}

PipelineResult TrajectoryPipeline::Solve() const {
  return Run(problem_, starts_, options_).Solve();
}

}  // namespace phongpd
