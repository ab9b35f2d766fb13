// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize_in_time.h"

#include <algorithm>

#include "constraints/curve_judge.h"
#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/solve/best_curve.h"
#include "planners/solve/optimize_among_moving.h"
#include "planners/solve/plan.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

// Whoever names a margin means it; the default is only kept where that costs
// little (CurveOptions::margin_price).
constexpr double kPriceOfOwnMargin = 200.0;

// Of a place on the way.
std::string ViaName(std::size_t i) { return "via " + std::to_string(i); }

// What nothing needs to be built for.
void RequireMotion(const Path& path, const CurveOptions& options) {
  options.Validate();
  const bool moves =
      std::any_of(path.begin(), path.end(),
                  [&](const Vector3d& point) { return point != path.front(); });
  if (moves) return;
  throw InputError(
      "a motion in time: expected two different places at least, found " +
      (path.empty() ? std::string("none")
                    : "only (" + FormatPoint(path.front()) + ")"));
}

// That are refined.  Among what moves another way may be faster than to wait.
int RoutesOf(const OptimizeRequest& request) {
  constexpr int kAmongMoving = 3;
  return request.moving.empty()
             ? request.options.routes
             : std::max(request.options.routes, kAmongMoving);
}

// That OptimizeAlongBest chooses among: the way of the fastest motion is often
// none of the three shortest ones.
int ComparedRoutesOf(const OptimizeRequest& request) {
  constexpr int kMostCompared = 8;
  const bool compares =
      request.moving.empty() && request.preset != Preset::kFast;
  return std::max(RoutesOf(request), compares ? kMostCompared : 1);
}

// Near one of these paths, which are free.
void FindCurve(const World& world, const OptimizeRequest& request,
               const std::vector<Path>& paths, PathAnswer* answer) {
  const CurveOptions options = CurveOptionsOf(world, request);
  const FreeSpace& space = *answer->evidence.free_space;
  BestCurve best =
      OptimizeAlongBest(space, world.diagonal(), paths, options,
                        request.requires_margin, RoutesOf(request));
  answer->path = paths[best.path];
  answer->routes = best.tried;
  answer->curve = std::move(best.summary);
  CurveSummary& curve = *answer->curve;
  answer->status = curve.status;
  answer->seconds += curve.seconds;
  if (curve.status == PathStatus::kDurationTooShort) {
    answer->reason = "the fastest that was found takes " +
                     Rounded(curve.duration, 6) + " s, not " +
                     Rounded(options.duration, 6);
  }
  if (curve.trajectory.empty()) return;
  answer->motion = curve.trajectory;
  answer->length = answer->motion.ArcLength();
  answer->clearance = curve.clearance;
  answer->evidence.use = BoundLimitUse(answer->motion, options.limits);
  answer->is_free = answer->is_solved =
      CheckCurve(space, answer->motion).IsFree() &&
      answer->evidence.use.IsKept();
  if (answer->is_free) {
    KeepOffMoving(world, request, paths, best.motions, answer);
    return;
  }
  answer->status = PathStatus::kNotCertified;
  answer->reason = "the judge of curves does not confirm what was found";
}

// Where a path collides, and with what.
std::string Collision(const World& world, const Path& path,
                      const PathCheck& check) {
  const auto i = static_cast<std::size_t>(check.segment);
  const double fraction = check.motion.fraction;
  const auto at = [&](double f) -> Vector3d {
    return path[i] + f * (path[i + 1] - path[i]);
  };
  std::string text = "the path first collides in segment " + std::to_string(i) +
                     " at fraction " + Rounded(fraction, 6);
  // There it only touches, up to rounding.
  Diagnosis diagnosis = world.Diagnose(at(fraction));
  if (diagnosis.IsFree()) {
    diagnosis = world.Diagnose(at(std::min(1.0, fraction + 1e-6)));
  }
  return text + ": " +
         (diagnosis.IsFree() ? "(" + FormatPoint(at(fraction)) + ")"
                             : diagnosis.Text("q"));
}

// The first of these places that is not free, or nothing.
std::string BlockedVia(const World& world, const std::vector<Via>& via) {
  for (std::size_t i = 0; i < via.size(); ++i) {
    const Diagnosis diagnosis = world.Diagnose(via[i].point);
    if (!diagnosis.IsFree()) return diagnosis.Text(ViaName(i));
  }
  return "";
}

// "from the start to via 0"
std::string LegName(std::size_t leg, std::size_t legs) {
  return "from " + (leg == 0 ? "the start" : ViaName(leg - 1)) + " to " +
         (leg + 1 == legs ? "the goal" : ViaName(leg));
}

PlanRequest LegRequest(const OptimizeRequest& request, const Vector3d& start,
                       const Vector3d& goal) {
  PlanRequest leg;
  leg.start = start;
  leg.goal = goal;
  leg.model = request.model;
  leg.clearance = request.Margin();
  leg.preset = request.preset;
  const int routes = ComparedRoutesOf(request);
  ContactSurfaceOptions by_preset;
  ApplyPreset(request.preset, &by_preset);
  if (routes > by_preset.routes) leg.routes = routes;
  leg.verifies = false;  // the motion is
  return leg;
}

// The ways from place to place that contact-surface compared, the one it chose
// first: `count` at most, and those that are free in `space`.
std::vector<Path> WaysOf(const PathAnswer& leg, std::size_t count,
                         const FreeSpace& space) {
  std::vector<Path> ways = {leg.path};
  for (const Path& route : leg.plan->routes) {
    if (ways.size() >= count) break;
    if (std::find(ways.begin(), ways.end(), route) != ways.end()) continue;
    if (CheckPath(space, route).free) ways.push_back(route);
  }
  return ways;
}

// The paths of contact-surface from place to place, each whole: the k-th is
// made of the k-th ways of the legs, or their last ones.  Empty, and why, where
// a leg has none.
std::vector<Path> FindPaths(const World& world, const OptimizeRequest& request,
                            const Path& places, PathAnswer* answer) {
  const std::size_t legs = places.size() - 1;
  const auto count = static_cast<std::size_t>(ComparedRoutesOf(request));
  std::vector<Path> paths(count, Path{places.front()});
  std::size_t most = 1;
  for (std::size_t i = 0; i < legs; ++i) {
    if (places[i] == places[i + 1]) continue;
    PathAnswer leg =
        PlanLifted(world, LegRequest(request, places[i], places[i + 1]));
    answer->seconds += leg.seconds;
    answer->evidence.model = leg.evidence.model;
    answer->evidence.refusal = leg.evidence.refusal;
    answer->evidence.free_space = leg.evidence.free_space;
    if (leg.is_solved) {
      const std::vector<Path> ways =
          WaysOf(leg, count, *leg.evidence.free_space);
      most = std::max(most, ways.size());
      for (std::size_t k = 0; k < count; ++k) {
        const Path& way = ways[std::min(k, ways.size() - 1)];
        paths[k].insert(paths[k].end(), way.begin() + 1, way.end());
      }
      answer->plan = std::move(leg.plan);
      continue;
    }
    answer->plan = std::move(leg.plan);
    if (leg.IsInfeasible() && legs > 1) {
      leg.status = PathStatus::kFailed;
      leg.reason = LegName(i, legs) +
                   ": no path, proved for these places, not for places "
                   "near them";
    }
    answer->status = leg.status;
    answer->reason = leg.reason;
    if (leg.IsInfeasible()) answer->evidence.surface = leg.evidence.surface;
    return {};
  }
  paths.resize(most);
  return paths;
}

}  // namespace

CurveOptions CurveOptionsOf(const World& world,
                            const OptimizeRequest& request) {
  if (!request.limits) {
    throw InputError("limits: expected those of the motion, found none");
  }
  RequireMovingRequest(world, request);
  PipelineOptions checked;
  checked.routes = request.options.routes;
  checked.Validate();
  CurveOptions options;
  options.limits = *request.limits;
  options.start = request.departure;
  options.end = request.arrival;
  options.margin = world.Resolve(request.Margin()).unit;
  if (request.margin) options.margin_price = kPriceOfOwnMargin;
  options.preset = request.preset;
  options.duration = request.duration;
  options.time_limit = request.options.time_limit;
  options.is_interrupted = request.is_interrupted;
  for (const Via& via : request.via) {
    options.via.push_back(
        {via.point, world.Resolve(via.tolerance).unit, via.dwell});
  }
  return options;
}

void OptimizeInTime(const World& world, const OptimizeRequest& request,
                    PathAnswer* answer) {
  Path places = {request.start};
  for (const Via& via : request.via) places.push_back(via.point);
  places.push_back(request.goal);
  RequireMotion(places, CurveOptionsOf(world, request));
  // Said by the planner before it builds anything.
  if (request.start != request.goal && !world.Diagnose(request.goal).IsFree()) {
    places = {request.start, request.goal};
  }
  answer->curve.emplace();
  if (!AreEndsClear(world, request, request.start, request.goal, answer)) {
    return;
  }
  answer->reason = BlockedVia(world, request.via);
  if (!answer->reason.empty()) {
    answer->status = PathStatus::kViaNotFree;
    return;
  }
  const std::vector<Path> paths = FindPaths(world, request, places, answer);
  if (paths.empty()) return;
  // With the bounds as a box instead of triangles.
  if (answer->evidence.model == Model::kWindow) {
    answer->evidence.free_space = world.Convolution().free_space;
  }
  FindCurve(world, request, paths, answer);
}

void RetimePath(const World& world, const Path& path,
                const OptimizeRequest& request, PathAnswer* answer) {
  RequireMotion(path, CurveOptionsOf(world, request));
  answer->curve.emplace();
  if (!AreEndsClear(world, request, path.front(), path.back(), answer)) return;
  answer->path = path;
  answer->evidence.model = Model::kWindow;
  answer->evidence.free_space = world.Convolution().free_space;
  answer->evidence.check = CheckPath(*answer->evidence.free_space, path);
  if (!answer->evidence.check.free) {
    answer->status = PathStatus::kNotFree;
    answer->reason = Collision(world, path, answer->evidence.check);
    return;
  }
  FindCurve(world, request, {path}, answer);
}

}  // namespace phongpd::internal
