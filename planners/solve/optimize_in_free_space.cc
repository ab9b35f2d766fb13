// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize_in_free_space.h"

#include <algorithm>
#include <utility>

#include "core/stopwatch.h"
#include "planners/exact/path_resampling.h"
#include "planners/exact/path_shortening.h"
#include "planners/ompl/ompl_planning.h"
#include "planners/trajectory/corridor.h"

namespace phongpd {
namespace {

constexpr PlannerId kPlanner = PlannerId::kRrtConnect;

class Run {
 public:
  Run(const TrajectoryProblem& problem, const MotionDomain& domain,
      const PipelineOptions& options, double planner_seconds)
      : problem_(problem),
        domain_(domain),
        options_(options),
        planner_seconds_(planner_seconds) {}

  PipelineResult Solve() {
    if (CheckEnds(problem_, &result_)) {
      for (int route = 0; route < options_.routes; ++route) {
        const Path start = FindStart(route);
        if (!start.empty()) Improve(start, route);
        // The line is one way, and time may be up.
        if (is_line_ || stopwatch_.Seconds() >= options_.time_limit) break;
      }
    }
    result_.certificate = CheckPath(*problem_.free_space, result_.path);
    result_.seconds = stopwatch_.Seconds();
    return std::move(result_);
  }

 private:
  double Left() const {
    return std::max(1e-3, options_.time_limit - stopwatch_.Seconds());
  }

  void Note(StageRecord record, const Path& path) {
    AddStage(problem_, path, std::move(record), &result_);
  }

  void Fail(const std::string& reason) {
    if (!HasFreePath(result_.status)) result_.reason = reason;
  }

  // Exactly free, of waypoints + 2 points; empty where there is none.
  Path FindStart(int route) {
    const Path line = StraightPath(problem_);
    if (CheckPath(*problem_.free_space, line).free) {
      is_line_ = true;
      Note({"start", route, "straight", false, 0.0, 0, 0.0}, line);
      return line;
    }
    if (options_.start == TrajectoryStart::kStraight) {
      is_line_ = true;
      Note({"start", route, "straight", false, 0.0, 0, 0.0}, line);
      Fail(
          "the line collides, and free space alone does not tell the way out; "
          "take --start repaired, or model full");
      return {};
    }
    return Search(route);
  }

  Path Search(int route) {
    SearchedWay way =
        SearchWay(problem_, domain_, std::min(planner_seconds_, Left()),
                  options_.seed + static_cast<std::uint64_t>(route));
    if (way.path.empty()) Fail(way.reason);
    result_.repair.seconds += way.seconds;
    Note({"start", route, way.path.empty() ? "failed" : ToString(kPlanner),
          false, 0.0, 0, way.seconds},
         way.path);
    return std::move(way.path);
  }

  void Improve(const Path& start, int route) {
    CorridorSummary summary;
    summary.path = start;
    PathStatus status = PathStatus::kStalledFeasible;
    std::string reason = "polish never";
    if (options_.polish != PolishWhen::kNever) {
      summary = PolishInCorridor(problem_, start, Left(),
                                 OfStage(options_.on_path, "corridor", route));
      Note({"corridor", route, ToString(summary.status), false, 0.0,
            summary.iterations, summary.seconds},
           summary.path);
      reason = std::string("the corridor ") + ToString(summary.status);
      if (summary.HasConverged()) {
        status = PathStatus::kPolished;
        reason.clear();
      }
    }
    Keep(std::move(summary.path), status, reason, route);
  }

  // If it is better: clearance first, as in the pipeline.
  void Keep(Path path, PathStatus status, const std::string& reason,
            int route) {
    const double objective = PathEnergy(problem_, path);
    const double missing = MissingClearance(problem_, path);
    const bool is_clear = missing <= kToleratedMissing;
    if (HasFreePath(result_.status)) {
      const bool was_clear = result_.missing_clearance <= kToleratedMissing;
      if (is_clear != was_clear ? was_clear : objective >= result_.objective) {
        return;
      }
    }
    result_.path = std::move(path);
    result_.status = status;
    result_.reason = reason;
    result_.objective = objective;
    result_.missing_clearance = missing;
    result_.route = route;
  }

  const TrajectoryProblem& problem_;
  const MotionDomain& domain_;
  const PipelineOptions& options_;
  const double planner_seconds_;
  Stopwatch stopwatch_;
  bool is_line_ = false;
  PipelineResult result_;
};

}  // namespace

SearchedWay SearchWay(const TrajectoryProblem& problem,
                      const MotionDomain& domain, double planner_seconds,
                      std::uint64_t seed) {
  const Stopwatch stopwatch;
  OmplPlanningOptions options;
  options.time_limit = planner_seconds;
  options.seed = seed;
  const OmplPlanningResult found =
      PlanWithOmpl(domain, problem.start, problem.goal, kPlanner, options);
  SearchedWay way;
  if (found.collision_free) {
    ShorteningOptions shortening;
    shortening.clearance = problem.margin * Diagonal(problem);
    shortening.seed = seed;
    way.path = ResampleKeepingCorners(
        ShortenPath(found.path, *problem.free_space, shortening),
        problem.waypoints);
    if (way.path.empty()) {
      way.reason = "the way found has more corners than the path's " +
                   std::to_string(problem.waypoints) + " waypoints";
    } else if (!CheckPath(*problem.free_space, way.path).free) {
      way.reason = "the way found is too narrow for its rounded waypoints";
      way.path.clear();
    }
  } else {
    way.reason = std::string(ToString(kPlanner)) + " found no way (" +
                 found.status + "), which proves nothing";
  }
  way.seconds = stopwatch.Seconds();
  return way;
}

PipelineResult OptimizeInFreeSpace(const TrajectoryProblem& problem,
                                   const MotionDomain& domain,
                                   const PipelineOptions& options,
                                   double planner_seconds) {
  problem.Validate();
  options.Validate();
  return Run(problem, domain, options, planner_seconds).Solve();
}

}  // namespace phongpd
