// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/window_planner.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/free_space_flood.h"
#include "core/mesh/finite.h"
#include "core/pi.h"
#include "core/stopwatch.h"
#include "planners/exact/path_shortening.h"
#include "planners/exact/route_order.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using FloodOutcome = FreeSpaceFlood::Outcome;

// A straight way is taken that keeps this share of its ends' clearance.
constexpr double kStraightShare = 0.4;
// Where ends that met are not connected after all, so much more is explored
// before they are looked at again.
constexpr double kMoreShare = 0.5;

// A path that keeps less than this share of the clearance its ends would allow
// is looked for once more, and not more often than so.
constexpr double kPoor = 0.25;
constexpr int kFurtherRounds = 3;

bool IsBetter(const PlanResult& found, const PlanResult& best,
              const RouteRequest& request) {
  if (best.status != PathStatus::kSolved) return true;
  if (found.status != PathStatus::kSolved) return false;
  // The surface of each exploration has a rounding of its own.
  const double wish = request.keeps_clearance ? request.clearance : 0.0;
  return RouteOrder(std::max(found.rounding, best.rounding), wish)
      .IsBetter({found.length, found.clearance}, {best.length, best.clearance});
}

// Bends each segment that is not free aside, where it is met first, by as
// little as helps.  False where nothing does, with *path as far as it came.
bool BendAside(const FreeSpace& space, double diagonal,
               std::vector<Vector3d>* path) {
  constexpr int kLeast = -30, kMost = -7;  // powers of two of the diagonal
  constexpr int kDirections = 12;
  const auto bend = [&](const Vector3d& a, const Vector3d& b, Vector3d* aside) {
    const Vector3d place =
        a + CheckPath(space, {a, b}).motion.fraction * (b - a);
    const Vector3d across = (b - a).unitOrthogonal();
    const Vector3d other = (b - a).cross(across).normalized();
    for (int k = 0; k < (kMost - kLeast + 1) * kDirections; ++k) {
      const double size = std::ldexp(diagonal, kLeast + k / kDirections);
      const double angle = 2.0 * kPi * (k % kDirections) / kDirections;
      *aside =
          place + size * (std::cos(angle) * across + std::sin(angle) * other);
      if (space.IsFree(a, *aside) && space.IsFree(*aside, b)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i + 1 < path->size(); ++i) {
    if (space.IsFree((*path)[i], (*path)[i + 1])) continue;
    Vector3d aside;
    if (!bend((*path)[i], (*path)[i + 1], &aside)) return false;
    path->insert(path->begin() + static_cast<std::ptrdiff_t>(++i), aside);
  }
  return true;
}

bool IsEnclosed(FloodOutcome outcome) {
  return outcome == FloodOutcome::kStartEnclosed ||
         outcome == FloodOutcome::kGoalEnclosed;
}

}  // namespace

WindowPlanner::WindowPlanner(const ConvolutionModel& sealed,
                             const ContactSurfaceOptions& options,
                             ObstacleNames names)
    : model_(sealed),
      options_((options.Validate(), options)),
      names_(std::move(names)),
      space_(FreeSpace::OfConvolutions({sealed})) {}

bool WindowPlanner::TryStraight(const Vector3d& start, const Vector3d& goal,
                                const RouteRequest& request,
                                PlanResult* result) const {
  if (!space_.IsFree(start, goal)) return false;
  const double least = space_.Clearance(start, goal);
  const double ends = std::min(
      {request.clearance, space_.Clearance(start), space_.Clearance(goal)});
  const double share =
      request.keeps_clearance ? kKeptOfClearance : kStraightShare;
  const bool is_clear = start == goal || least >= share * ends;
  if (!is_clear && !request.keeps_clearance) return false;
  result->status = PathStatus::kSolved;
  result->path = {start};
  if (start != goal) result->path.push_back(goal);
  result->raw_path = result->path;
  result->routes = {result->path};
  result->length = (goal - start).norm();
  result->clearance = least;
  return is_clear;
}

// From walls to all of free space.
void WindowPlanner::Widen(const Vector3d& start, const Vector3d& goal,
                          PlanResult* result) const {
  const auto join_ends = [&](std::vector<Vector3d>* path) {
    if (path->front() != start) path->insert(path->begin(), start);
    if (path->back() != goal) path->push_back(goal);
  };
  ShorteningOptions shortening;
  shortening.clearance = result->wanted_clearance;
  shortening.random_cuts = options_.random_cuts;
  join_ends(&result->raw_path);
  for (std::vector<Vector3d>& route : result->routes) join_ends(&route);
  join_ends(&result->path);
  // Against the surface, whose corners are rounded, a path may be free that
  // grazes what the model knows exactly.
  const double diagonal = model_.bounds().Diagonal();
  if (!BendAside(space_, diagonal, &result->path) &&
      !BendAside(space_, diagonal, &result->raw_path)) {
    result->status = PathStatus::kFailed;
    result->reason = "a path was found that is closed by rounding";
    return;
  }
  if (!CheckPath(space_, result->path).free) result->path = result->raw_path;
  result->path = ShortenPath(result->path, space_, shortening,
                             result->keeps_clearance ? 1.0 : kClearanceKept);
  result->length = PathLength(result->path);
  result->clearance = PathClearance(space_, result->path);
}

void WindowPlanner::Explore(const Vector3d& start, const Vector3d& goal,
                            const RouteRequest& request,
                            WindowPlan* out) const {
  const double enough = (request.keeps_clearance ? kKeptOfClearance : kPoor) *
                        std::min({request.clearance, space_.Clearance(start),
                                  space_.Clearance(goal)});
  FreeSpaceFlood flood(model_, start, goal);
  PlanResult& best = out->plan;
  std::size_t more = std::numeric_limits<std::size_t>::max() / 2;
  int further = kFurtherRounds;
  for (bool is_enclosed = false; !is_enclosed;) {
    const FloodOutcome outcome = flood.Explore(more);
    is_enclosed = IsEnclosed(outcome);
    PlanResult found;
    try {
      const ExploredSpace surface = flood.Surface();
      found = ContactSurfacePlanner(surface.AsContactSpace(), options_, names_)
                  .Plan(flood.start(), flood.goal(), request);
      if (found.status == PathStatus::kSolved) Widen(start, goal, &found);
      if (IsBetter(found, best, request)) {
        best = std::move(found);
        const bool is_proof =
            is_enclosed && best.status == PathStatus::kInfeasibleProved;
        out->surface = is_proof ? flood.EnclosingSurface() : surface;
      }
    } catch (const std::logic_error&) {
      if (best.status != PathStatus::kSolved) {
        best.reason =
            "cells at the walls of boxes are too thin to be judged; take the "
            "full contact space";
      }
    }
    if (best.status == PathStatus::kSolved &&
        (best.clearance >= enough || further-- == 0)) {
      break;
    }
    more = static_cast<std::size_t>(kMoreShare *
                                    static_cast<double>(flood.faces()));
  }
  out->boxes = flood.boxes();
  out->faces = flood.faces();
}

WindowPlan WindowPlanner::Plan(const Vector3d& start, const Vector3d& goal,
                               const RouteRequest& request) const {
  request.Validate();
  const Stopwatch stopwatch;
  WindowPlan out;
  PlanResult& result = out.plan;
  for (const bool at_start : {true, false}) {
    const Vector3d& q = at_start ? start : goal;
    if (IsFinite(q) && space_.IsFree(q)) continue;
    const std::string names = names_ && IsFinite(q) ? names_(q) : "";
    result.status =
        at_start ? PathStatus::kStartInCollision : PathStatus::kGoalInCollision;
    result.reason = std::string(at_start ? "start" : "goal") +
                    (IsFinite(q) ? " touches or is in " : " is not finite") +
                    (!IsFinite(q)    ? ""
                     : names.empty() ? "an obstacle"
                                     : "'" + names + "'");
    result.seconds = stopwatch.Seconds();
    return out;
  }
  RouteRequest wish = request;
  if (wish.clearance <= 0.0) {
    wish.clearance = kEnoughClearance * model_.bounds().Diagonal();
    wish.keeps_clearance = false;
  }
  if (!TryStraight(start, goal, wish, &result)) {
    Explore(start, goal, wish, &out);
  }
  result.wanted_clearance = wish.clearance;
  result.seconds = stopwatch.Seconds();
  return out;
}

}  // namespace phongpd
