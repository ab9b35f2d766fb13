// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/ipopt_optimizer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/trajectory/trajectory_nlp.h"

namespace phongpd {

namespace {

// Segments that touch something get twice the samples; false if none can.
bool Refine(const FreeSpace& space, const Path& path,
            std::vector<int>* samples) {
  bool has_changed = false;
  for (std::size_t i = 0; i < samples->size(); ++i) {
    int& count = (*samples)[i];
    if (count >= kMaxSamplesPerSegment || space.IsFree(path[i], path[i + 1]))
      continue;
    count = std::min(2 * count + 1, kMaxSamplesPerSegment);
    has_changed = true;
  }
  return has_changed;
}

void Add(const IpoptRun& run, const NonPenetrationCounts& counts,
         TrajectorySummary* summary) {
  summary->status = run.status;
  summary->raw_status = run.raw_status;
  summary->violation = run.violation;
  summary->dual_infeasibility = run.dual_infeasibility;
  summary->iterations += run.iterations;
  summary->restoration_iterations += run.restoration_iterations;
  summary->evaluations.objective += run.evaluations.objective;
  summary->evaluations.gradient += run.evaluations.gradient;
  summary->evaluations.constraints += run.evaluations.constraints;
  summary->evaluations.jacobian += run.evaluations.jacobian;
  summary->evaluations.hessian += run.evaluations.hessian;
  summary->queries.cold += counts.cold;
  summary->queries.warm += counts.warm;
  summary->queries.branch_ends += counts.branch_ends;
  summary->queries.branch_changes += counts.branch_changes;
  summary->queries.fallbacks += counts.fallbacks;
  summary->seconds_callbacks += run.seconds_callbacks;
  const int offset = static_cast<int>(summary->log.size());
  for (IterationRecord record : run.log) {
    record.iteration += offset;
    summary->log.push_back(record);
  }
}

void Judge(const TrajectoryProblem& problem, TrajectorySummary* summary) {
  summary->first_crossing = CheckPath(*problem.free_space, summary->path);
  summary->collision_free = summary->first_crossing.free;
  const double energy = PathEnergy(problem, summary->path);
  summary->objective =
      std::isfinite(energy) ? energy : std::numeric_limits<double>::max();
}

}  // namespace

void TrajectoryOptions::Validate() const {
  ipopt.Validate();
  CheckOption(rows >= 1 && rows <= kMaxMetricRows, "trajectory", "rows",
              "1 to 8", rows);
  static_assert(kMaxMetricRows == 8, "the message says so");
  CheckOption(max_rounds >= 1, "trajectory", "max_rounds", "≥ 1", max_rounds);
}

bool TrajectorySummary::IsSolved() const {
  return IsClassOk(status) && collision_free && objective < 1e300;
}

IpoptTrajectoryOptimizer::IpoptTrajectoryOptimizer(
    const TrajectoryProblem& problem, const TrajectoryOptions& options)
    : problem_(problem), options_(options) {
  problem_.Validate();
  options_.Validate();
  CheckIpoptOptions(options_.ipopt);
}

TrajectorySummary IpoptTrajectoryOptimizer::Solve(
    const Path& start_path, const PathObserver& on_path) const {
  const Stopwatch stopwatch;
  CheckStartPath(problem_, start_path);
  const FreeSpace& space = *problem_.free_space;
  TrajectorySummary summary;
  summary.path = start_path;
  const bool is_start_free = space.IsFree(problem_.start);
  if (!is_start_free || !space.IsFree(problem_.goal)) {
    summary.status =
        is_start_free ? SolveStatus::kInvalidGoal : SolveStatus::kInvalidStart;
    Judge(problem_, &summary);
    summary.seconds_total = stopwatch.Seconds();
    return summary;
  }
  // Nothing to avoid or nowhere to go: the straight line is optimal.
  if (problem_.metrics.empty() || problem_.start == problem_.goal) {
    summary.path = StraightPath(problem_);
    summary.status = SolveStatus::kConverged;
    Judge(problem_, &summary);
    summary.dual_infeasibility = 0.0;
    summary.seconds_total = stopwatch.Seconds();
    return summary;
  }

  const double start_length = PathLength(start_path);
  summary.samples.assign(static_cast<std::size_t>(problem_.waypoints) + 1,
                         SamplesPerSegment(problem_, start_length));
  while (true) {
    TrajectoryNlp nlp(problem_, summary.samples, start_length, options_.rows);
    const Eigen::VectorXd u = nlp.ToVariables(summary.path);
    nlp.Start(u);
    IpoptSettings settings = options_.ipopt;
    const std::function<Path(const Eigen::VectorXd&)> path_of =
        [&nlp](const Eigen::VectorXd& x) { return nlp.ToPath(x); };
    TellPaths(on_path, summary.rounds, path_of, &settings);
    settings.time_limit =
        std::max(1e-3, options_.ipopt.time_limit - stopwatch.Seconds());
    const IpoptRun run = SolveWithIpopt(&nlp, u, settings);
    ++summary.rounds;
    Add(run, nlp.counts(), &summary);
    summary.path = nlp.ToPath(run.x);
    Judge(problem_, &summary);
    const bool has_failed = run.status == SolveStatus::kInfeasible ||
                            run.status == SolveStatus::kNumerical;
    const bool may_go_on = IsClassOk(run.status) ||
                           run.status == SolveStatus::kIterationLimit ||
                           has_failed;
    if (summary.collision_free || !may_go_on ||
        summary.rounds >= options_.max_rounds ||
        !Refine(space, summary.path, &summary.samples)) {
      break;
    }
  }
  summary.seconds_total = stopwatch.Seconds();
  return summary;
}

}  // namespace phongpd
