// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize.h"

#include <stdexcept>
#include <utility>

#include "core/minkowski/build_stop.h"
#include "planners/solve/finish_answer.h"
#include "planners/solve/optimize_among_moving.h"
#include "planners/solve/optimize_by_windows.h"
#include "planners/solve/optimize_in_free_space.h"
#include "planners/solve/optimize_in_time.h"
#include "planners/solve/plan.h"

namespace phongpd {
namespace {

using Metrics = std::vector<std::shared_ptr<const SignedMetric>>;

SpaceLayout LayoutOf(const OptimizeRequest& request) {
  return request.is_per_obstacle ? SpaceLayout::kPerObstacle
                                 : SpaceLayout::kMerged;
}

// All but the metrics and their judge.
TrajectoryProblem SettingsOf(const World& world,
                             const OptimizeRequest& request) {
  TrajectoryProblem problem;
  problem.diagonal = world.diagonal();
  problem.start = request.start;
  problem.goal = request.goal;
  problem.waypoints = request.waypoints;
  problem.samples_per_segment = request.samples_per_segment;
  problem.margin = world.Resolve(request.Margin()).share;
  problem.max_segment_ratio = request.max_segment_ratio;
  return problem;
}

Metrics MakeMetrics(const World& world, const OptimizeRequest& request) {
  const SignedMetricOptions options =
      request.penetration.Options(world.diagonal());
  Metrics metrics;
  for (const ContactSpace& space : world.Spaces(LayoutOf(request)).spaces) {
    metrics.push_back(request.own_metric
                          ? std::make_shared<SignedMetric>(
                                space,
                                request.own_metric->make(space, options.phong),
                                options)
                          : std::make_shared<SignedMetric>(space, options));
  }
  return metrics;
}

// Bad options are refused, and blocked ends are told, before anything is built:
// the pipeline's own checks need no contact space.
void RequirePolyline(const World& world, const OptimizeRequest& request) {
  TrajectoryProblem problem = SettingsOf(world, request);
  problem.free_space = std::make_shared<FreeSpace>(std::vector<ContactSpace>());
  PipelineOptions straight = request.options;
  straight.start = TrajectoryStart::kStraight;
  TrajectoryPipeline(problem, nullptr, straight);
  request.penetration.Options(world.diagonal()).Validate();
}

// Repairing starts needs the sealed space as well.
bool UsesWindow(const World& world, const OptimizeRequest& request,
                std::string* refusal) {
  std::vector<SpaceLayout> layouts;
  if (request.options.start != TrajectoryStart::kStraight) {
    layouts.push_back(SpaceLayout::kSealed);
  }
  layouts.push_back(LayoutOf(request));
  return internal::UsesWindow(world, request.model, layouts, refusal);
}

// Beside what refused the whole.
void TellRefusal(const std::string& what, PathAnswer* answer) {
  std::string& refusal = answer->evidence.refusal;
  refusal += (refusal.empty() ? "" : "; ") + ("windows: " + what);
}

PipelineResult RunInWindow(const World& world, const OptimizeRequest& request,
                           PathAnswer* answer) {
  const TrajectoryProblem problem = ProblemOf(world, request, Model::kWindow);
  const MotionDomain domain = {
      problem.free_space, WindowRegion(world, request.start, request.goal)};
  if (internal::HasWindowMetric(request)) {
    // What windows cannot model is said, and free space does without.
    try {
      return internal::OptimizeByWindows(world, request, problem, domain,
                                         &answer->windows);
    } catch (const BuildRefusal& error) {
      TellRefusal(error.what(), answer);
    } catch (const std::logic_error& error) {
      TellRefusal(error.what(), answer);
    }
    answer->windows.reset();
  }
  return OptimizeInFreeSpace(problem, domain, request.options,
                             request.search_time);
}

PipelineResult RunInFull(const World& world, const OptimizeRequest& request) {
  std::shared_ptr<const StartRepair> repair;
  if (request.options.start != TrajectoryStart::kStraight) {
    repair = world.Kept<StartRepair>(
        "", [&world] { return StartRepair(world.Sealed()); });
  }
  return TrajectoryPipeline(ProblemOf(world, request), repair, request.options)
      .Solve();
}

void OptimizePolyline(const World& world, const OptimizeRequest& request,
                      PathAnswer* answer) {
  request.Validate(world);
  answer->pipeline.emplace();
  if (!internal::AreEndsFree(world, request.start, request.goal, answer)) {
    return;
  }
  const bool is_window = UsesWindow(world, request, &answer->evidence.refusal);
  answer->evidence.model = is_window ? Model::kWindow : Model::kFull;
  answer->evidence.free_space =
      is_window ? world.Convolution().free_space
                : world.Spaces(LayoutOf(request)).free_space;
  PipelineResult found = is_window ? RunInWindow(world, request, answer)
                                   : RunInFull(world, request);
  answer->status = found.status;
  answer->reason = found.reason;
  if (IsStartBlocked(found.status) || IsGoalBlocked(found.status)) {
    const bool at_start = IsStartBlocked(found.status);
    answer->reason = BlockedByRounding(at_start ? request.start : request.goal,
                                       at_start ? "start" : "goal");
  }
  answer->path = found.path;
  answer->evidence.check = found.certificate;
  answer->is_free = found.certificate.free;
  // In a fair comparison of solvers what counts is Ipopt's own class; with a
  // corridor behind it, the pipeline's.
  answer->is_solved =
      HasFreePath(found.status) &&
      (found.ipopt.IsSolved() || found.status != PathStatus::kStalledFeasible);
  answer->length = PathLength(answer->path);
  if (answer->is_free) {
    answer->clearance =
        PathClearance(*answer->evidence.free_space, answer->path);
  }
  answer->seconds = found.seconds;
  answer->pipeline = std::move(found);
}

internal::ClearanceWish WishOf(const OptimizeRequest& request) {
  return {"margin", request.Margin(), request.margin.has_value(),
          request.requires_margin};
}

void FinishOptimize(const World& world, const OptimizeRequest& request,
                    PathAnswer* answer) {
  // What moves is no part of what the second judge knows of places.
  const bool is_known =
      request.moving.empty() ||
      !internal::IsBlockedByMoving(world, request.start, request.goal, *answer);
  internal::Finish(world, request.start, request.goal, WishOf(request),
                   request.verifies && is_known, answer);
  internal::VerifyAmongMoving(world, request, answer);
}

}  // namespace

void OptimizeRequest::Validate(const World& world) const {
  RequireLength(Margin(), LengthRange::kAboveZero, world.diagonal(), "margin",
                world.workspace().unit);
  internal::RequireMovingRequest(world, *this);
  if (limits) {
    internal::CurveOptionsOf(world, *this).Validate();
  } else {
    RequirePolyline(world, *this);
  }
}

void ApplyPreset(Preset preset, OptimizeRequest* request) {
  request->preset = preset;
  PipelineOptions& options = request->options;
  const PipelineOptions balanced;
  const bool is_tight = preset == Preset::kTight;
  options.also_line = preset != Preset::kFast && balanced.also_line;
  options.routes = is_tight ? 3 : balanced.routes;
  options.polish = is_tight ? PolishWhen::kAlways : balanced.polish;
}

TrajectoryProblem ProblemOf(const World& world, const OptimizeRequest& request,
                            Model model) {
  TrajectoryProblem problem = SettingsOf(world, request);
  if (model == Model::kWindow) {
    problem.free_space = world.Convolution().free_space;
    return problem;
  }
  problem.free_space = world.Spaces(LayoutOf(request)).free_space;
  const std::string name = request.own_metric ? request.own_metric->name
                                              : request.penetration.Name();
  problem.metrics = *world.Kept<Metrics>(
      name + (request.is_per_obstacle ? ", each" : ", all"),
      [&] { return MakeMetrics(world, request); });
  return problem;
}

PathAnswer Optimize(const World& world, const OptimizeRequest& request) {
  PathAnswer answer;
  if (request.limits) {
    internal::OptimizeInTime(world, request, &answer);
  } else {
    OptimizePolyline(world, request, &answer);
  }
  FinishOptimize(world, request, &answer);
  return answer;
}

PathAnswer Retime(const World& world, const Path& path,
                  OptimizeRequest request) {
  PathAnswer answer;
  internal::RetimePath(world, path, request, &answer);
  request.start = path.front();
  request.goal = path.back();
  FinishOptimize(world, request, &answer);
  return answer;
}

std::string MarginBeyondReach(const World& world,
                              const OptimizeRequest& request) {
  return internal::BeyondTheEnds(world, request.start, request.goal,
                                 WishOf(request));
}

}  // namespace phongpd
