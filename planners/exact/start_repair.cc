// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/start_repair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bvh/triangle_bvh.h"
#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/exact/path_resampling.h"
#include "planners/exact/path_shortening.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

// Of its length when resampled; routes closer than that are the same.
constexpr double kSameRoute = 1e-3;

// Ways around the obstacles that are looked for, no fewer than may be asked
// for: their best parts make the routes.  Each takes as long as the first.
constexpr int kCandidates = 8;

constexpr int kStraighteningCuts = 120;  // of the straightening

constexpr double kClearance = 0.01;  // that is wished, of D

template <typename T>
void Check(const char* name, const char* range, bool holds, T value) {
  CheckOption(holds, "start repair", name, range, value);
}

Vector3d PointAt(const Path& path, double at) {
  const auto k = std::min(static_cast<std::size_t>(at), path.size() - 2);
  return path[k] + (at - static_cast<double>(k)) * (path[k + 1] - path[k]);
}

// Appends the path's points strictly between two places.
void AppendBetween(const Path& path, double from, double to, Path* out) {
  for (double k = std::floor(from) + 1.0; k < to; k += 1.0) {
    out->push_back(path[static_cast<std::size_t>(k)]);
  }
}

void Count(const PlanResult& plan, StartRepairResult* result) {
  result->searches += plan.searches;
  result->lift.lifted += plan.lift.lifted;
  result->lift.tests += plan.lift.tests;
  result->lift.halvings += plan.lift.halvings;
}

bool IsSame(const Path& one, const Path& other) {
  const double tolerance = kSameRoute * PathLength(one);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if ((one[i] - other[i]).norm() > tolerance) return false;
  }
  return true;
}

}  // namespace

void StartRepairOptions::Validate() const {
  Check("waypoints", "1 to 10000", waypoints >= 1 && waypoints <= 10000,
        waypoints);
  Check("clearance", "0 to 1e150", clearance >= 0.0 && clearance <= 1e150,
        clearance);
  Check("routes", "1 to 8", routes >= 1 && routes <= 8, routes);
}

struct StartRepair::Impl {
  Impl(const ContactSpace& merged, const ContactSurfaceOptions& options)
      : space({merged}),
        segments(merged.bvh()),
        planner(merged, options),
        diagonal(merged.length()) {}

  std::vector<double> FindContacts(const Path& path) const;
  std::vector<Path> PlanLine(const Path& path, const RouteRequest& request,
                             bool all, StartRepairResult* result) const;
  Path LeadAround(const Path& path, const std::vector<double>& contacts,
                  const RouteRequest& request, bool all,
                  StartRepairResult* result) const;
  Path Shorten(const Path& path, const StartRepairOptions& options,
               double clearance) const;
  Path Resample(Path path, const StartRepairOptions& options,
                StartRepairResult* result) const;
  void Repair(const Path& path, const StartRepairOptions& options,
              StartRepairResult* result) const;

  FreeSpace space;
  const TriangleBvh& segments;  // of the space
  ContactSurfacePlanner planner;
  double diagonal;
};

// Where the path meets the surface, segment + fraction, ascending.
std::vector<double> StartRepair::Impl::FindContacts(const Path& path) const {
  std::vector<double> contacts;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    segments.ForEachHit(path[k], path[k + 1], [&](int, double fraction) {
      contacts.push_back(static_cast<double>(k) + fraction);
    });
  }
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

// The straight way replaced as a whole, which leaves the planner free to find
// the shortest one.
std::vector<Path> StartRepair::Impl::PlanLine(const Path& path,
                                              const RouteRequest& request,
                                              bool all,
                                              StartRepairResult* result) const {
  PlanResult plan = planner.Plan(path.front(), path.back(), request, all);
  Count(plan, result);
  result->reason = plan.reason;
  if (plan.status == PathStatus::kInfeasibleProved) {
    result->status = PathStatus::kInfeasibleProved;
  }
  return std::move(plan.routes);
}

// A polyline with every colliding run led around and all that is free kept;
// empty if that fails.
Path StartRepair::Impl::LeadAround(const Path& path,
                                   const std::vector<double>& contacts,
                                   const RouteRequest& request, bool all,
                                   StartRepairResult* result) const {
  const double end = static_cast<double>(path.size() - 1);
  Path out = {path.front()};
  double done = 0.0;  // the given path is dealt with up to here, and free here
  for (std::size_t i = 0; i < contacts.size();) {
    const double before = 0.5 * (done + contacts[i]);
    PlanResult plan;
    double after = end;
    std::size_t next = i + 1;
    for (; next <= contacts.size(); ++next) {
      const double free_until = next < contacts.size() ? contacts[next] : end;
      after = 0.5 * (contacts[next - 1] + free_until);
      const Vector3d to = PointAt(path, after);
      if (!space.IsFree(to)) continue;
      plan = planner.Plan(PointAt(path, before), to, request, all);
      Count(plan, result);
      if (plan.status == PathStatus::kSolved) break;
    }
    if (plan.status != PathStatus::kSolved) return {};
    AppendBetween(path, done, before, &out);
    out.insert(out.end(), plan.path.begin(), plan.path.end());
    ++result->runs;
    done = after;
    i = next;
  }
  AppendBetween(path, done, end, &out);
  out.push_back(path.back());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Path StartRepair::Impl::Shorten(const Path& path,
                                const StartRepairOptions& options,
                                double clearance) const {
  ShorteningOptions shortening;
  shortening.clearance = clearance;
  shortening.random_cuts = kStraighteningCuts;
  shortening.seed = options.seed;
  return ShortenPath(path, segments, shortening);
}

Path StartRepair::Impl::Resample(Path path, const StartRepairOptions& options,
                                 StartRepairResult* result) const {
  if (static_cast<int>(path.size()) > options.waypoints + 2) {
    // Clearance is worth less than a path.
    path = Shorten(path, options, 0.0);
  }
  Path sampled = ResampleKeepingCorners(path, options.waypoints);
  if (sampled.empty()) {
    result->reason = "the path has " + std::to_string(path.size() - 2) +
                     " corners, more than waypoints (" +
                     std::to_string(options.waypoints) + ")";
  } else if (!CheckPath(space, sampled).free) {
    result->reason = "rounding made the resampled path collide";
    sampled.clear();
  }
  return sampled;
}

void StartRepair::Impl::Repair(const Path& path,
                               const StartRepairOptions& options,
                               StartRepairResult* result) const {
  if (!space.IsFree(path.front())) {
    result->status = PathStatus::kStartInCollision;
    result->reason = "the start collides";
    return;
  }
  if (!space.IsFree(path.back())) {
    result->status = PathStatus::kGoalInCollision;
    result->reason = "the goal collides";
    return;
  }
  const std::vector<double> contacts = FindContacts(path);
  if (contacts.empty()) {
    Path sampled = Resample(path, options, result);
    if (sampled.empty()) return;
    result->status = PathStatus::kFree;
    result->routes.push_back(std::move(sampled));
    return;
  }
  const double wished =
      options.clearance > 0.0 ? options.clearance : kClearance * diagonal;
  RouteRequest request;
  // Shortening gives a part of the clearance away.
  request.clearance = wished / kClearanceKept;
  request.routes = kCandidates;
  const bool all = options.routes > 1;
  std::vector<Path> found;
  if (path.size() > 2) {
    Path around = LeadAround(path, contacts, request, all, result);
    if (!around.empty()) {
      found.push_back(Shorten(around, options, request.clearance));
    }
  }
  // Also where a run of a polyline has no way around: what proves that there
  // is no path are its own ends.
  if (found.empty()) {
    result->runs = 1;
    found = PlanLine(path, request, all, result);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Path& a, const Path& b) {
                     return PathLength(a) < PathLength(b);
                   });
  for (Path& route : found) {
    if (static_cast<int>(result->routes.size()) == options.routes) break;
    Path sampled = Resample(std::move(route), options, result);
    if (sampled.empty()) continue;
    const bool is_known =
        std::any_of(result->routes.begin(), result->routes.end(),
                    [&](const Path& known) { return IsSame(known, sampled); });
    if (!is_known) result->routes.push_back(std::move(sampled));
  }
  if (result->routes.empty()) return;
  result->status = PathStatus::kRepaired;
  result->reason.clear();
}

StartRepair::StartRepair(const ContactSpace& merged,
                         const ContactSurfaceOptions& planner_options)
    : impl_(std::make_unique<Impl>(merged, planner_options)) {}
StartRepair::~StartRepair() = default;
StartRepair::StartRepair(StartRepair&&) noexcept = default;
StartRepair& StartRepair::operator=(StartRepair&&) noexcept = default;

StartRepairResult StartRepair::Repair(const Vector3d& start,
                                      const Vector3d& goal,
                                      const StartRepairOptions& options) const {
  return Repair(Path{start, goal}, options);
}

StartRepairResult StartRepair::Repair(const Path& path,
                                      const StartRepairOptions& options) const {
  options.Validate();
  Check("path", "2 points or more", path.size() >= 2, path.size());
  for (const Vector3d& q : path) {
    if (!IsFinite(q)) {
      throw InputError(
          "start repair: path: expected finite points, found NaN or Inf");
    }
  }
  const Stopwatch stopwatch;
  StartRepairResult result;
  impl_->Repair(path, options, &result);
  result.seconds = stopwatch.Seconds();
  return result;
}

const FreeSpace& StartRepair::space() const { return impl_->space; }
double StartRepair::diagonal() const { return impl_->diagonal; }

}  // namespace phongpd
