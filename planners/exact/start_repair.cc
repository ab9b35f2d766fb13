// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/start_repair.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "core/mesh/segment_tree.h"
#include "planners/exact/path_straightening.h"
#include "planners/exact/surface_geodesic.h"
#include "planners/exact/surface_lift.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using internal::SurfaceLift;
using Path = std::vector<Vector3d>;

// Where a path meets the surface.
struct Contact {
  double at = 0.0;  // segment + fraction
  int triangle = -1;
};

// A piece of the path that collides.
struct Run {
  Contact entry, exit;
};

struct Runs {
  std::vector<Run> runs;
  bool is_open = false;  // the last one does not come back to its component
};

Vector3d PointAt(const Path& path, double at) {
  const auto k = std::min(static_cast<std::size_t>(at), path.size() - 2);
  return path[k] + (at - static_cast<double>(k)) * (path[k + 1] - path[k]);
}

std::string Range(const char* name, const char* range, double value) {
  return std::string("start repair: ") + name + " must be " + range +
         ", found " + std::to_string(value);
}

}  // namespace

void StartRepairOptions::Validate() const {
  if (waypoints < 1) {
    throw InputError(Range("waypoints", "at least 1", waypoints));
  }
  if (!(margin > 0.0 && margin < 1.0)) {
    throw InputError(Range("margin", "in (0, 1)", margin));
  }
  if (!(diagonal >= 0.0 && diagonal <= 1e150)) {
    throw InputError(Range("diagonal", "in [0, 1e150]", diagonal));
  }
  if (routes < 1 || routes > 8) {
    throw InputError(Range("routes", "in [1, 8]", routes));
  }
  if (random_cuts < 0) {
    throw InputError(Range("random_cuts", "at least 0", random_cuts));
  }
}

const char* ToString(RepairStatus status) {
  switch (status) {
    case RepairStatus::kFree:
      return "free";
    case RepairStatus::kRepaired:
      return "repaired";
    case RepairStatus::kInfeasibleProved:
      return "infeasible_proved";
    case RepairStatus::kStartInCollision:
      return "start_in_collision";
    case RepairStatus::kGoalInCollision:
      return "goal_in_collision";
    case RepairStatus::kFailed:
      break;
  }
  return "failed";
}

struct StartRepair::Impl {
  Impl(const TriangleMesh& mesh, CompletePlanner complete)
      : space({mesh}),
        segments(mesh),
        geodesics(mesh),
        planner(std::move(complete)),
        diagonal(ComputeBounds(mesh).Diagonal()) {
    int count = 0;
    component = LabelComponents(mesh, &count);
  }

  Runs FindRuns(const Path& path) const;
  // The given path with every run led around; empty if that fails.
  Path LeadAround(const Path& path, const std::vector<Run>& runs, double margin,
                  std::vector<std::vector<DetourRegion>>* seen,
                  StartRepairResult* result) const;
  // Straightens and resamples; an empty result says why.
  void Finish(Path path, const StartRepairOptions& options, double margin,
              StartRepairResult* result) const;
  void AskPlanner(const Path& path, const StartRepairOptions& options,
                  double margin, StartRepairResult* result) const;
  void Repair(const Path& path, const StartRepairOptions& options,
              StartRepairResult* result) const;

  FreeSpace space;
  SegmentTree segments;
  SurfaceGeodesics geodesics;
  CompletePlanner planner;
  double diagonal;
  std::vector<int> component;  // of each triangle
};

Runs StartRepair::Impl::FindRuns(const Path& path) const {
  std::vector<Contact> contacts;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    segments.ForEachHit(path[k], path[k + 1], [&](int t, double fraction) {
      contacts.push_back({static_cast<double>(k) + fraction, t});
    });
  }
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& a, const Contact& b) {
              return a.at != b.at ? a.at < b.at : a.triangle < b.triangle;
            });
  // Is the path free just after contact i?  Between two contacts closer than
  // rounding there is nothing to ask.
  const auto leaves = [&](std::size_t i) {
    if (i + 1 == contacts.size()) return true;
    const double gap = contacts[i + 1].at - contacts[i].at;
    return gap > 1e-12 * static_cast<double>(path.size()) &&
           space.IsFree(PointAt(path, contacts[i].at + 0.5 * gap));
  };
  Runs result;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const int wanted = component[contacts[i].triangle];
    std::size_t exit = i;
    // Several contacts at one place count as one: the exit may be any of
    // those at the place after which the path is free.
    bool has_seen = false;
    for (; exit < contacts.size(); ++exit) {
      if (exit > i && contacts[exit].at > contacts[exit - 1].at) {
        has_seen = false;
      }
      has_seen |= component[contacts[exit].triangle] == wanted;
      if (has_seen && leaves(exit)) break;
    }
    if (exit == contacts.size()) {
      result.is_open = true;
      return result;
    }
    Contact last = contacts[exit];
    for (std::size_t j = exit; component[last.triangle] != wanted; --j) {
      last = contacts[j];
    }
    result.runs.push_back({contacts[i], last});
    i = exit;
  }
  return result;
}

Path StartRepair::Impl::LeadAround(const Path& path,
                                   const std::vector<Run>& runs, double margin,
                                   std::vector<std::vector<DetourRegion>>* seen,
                                   StartRepairResult* result) const {
  const SurfaceLift lift(space, segments, geodesics.facet_normals(), diagonal,
                         margin);
  seen->resize(runs.size());
  Path out = {path.front()};
  double done = 0.0;  // of the given path
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Run& run = runs[r];
    // A point of the path near the contact at `at`, on the side of `towards`,
    // a contact or an end, at most half way to it and on the same segment.
    const auto beside = [&](const Contact& contact, double towards) {
      const auto k =
          std::min(static_cast<std::size_t>(contact.at), path.size() - 2);
      const double low = static_cast<double>(k);
      const double limit = std::clamp(towards, low, low + 1.0);
      const double length = (path[k + 1] - path[k]).norm();
      const double most = margin / std::max(length, margin);
      const double step = std::clamp(0.5 * (limit - contact.at), -most, most);
      const Vector3d foot = PointAt(path, contact.at);
      const Vector3d offset = PointAt(path, contact.at + step) - foot;
      const double height = offset.norm();
      return SurfaceLift::Point{
          foot, height > 0.0 ? Vector3d(offset / height) : offset, height,
          contact.triangle};
    };
    const double next = r + 1 < runs.size()
                            ? runs[r + 1].entry.at
                            : static_cast<double>(path.size() - 1);
    const SurfaceLift::Point before = beside(run.entry, done);
    const SurfaceLift::Point after = beside(run.exit, next);
    Path lifted;
    for (const auto vertices : {SurfaceGeodesics::Vertices::kAllowed,
                                SurfaceGeodesics::Vertices::kAvoided}) {
      const Geodesic geodesic =
          geodesics.Find(before.foot, run.entry.triangle, after.foot,
                         run.exit.triangle, (*seen)[r], vertices);
      result->settled += geodesic.settled;
      if (!geodesic.found) return {};
      lifted = lift.Lift(before, geodesic, after, &result->lift);
      if (lifted.empty()) continue;
      const Vector3d& middle =
          geodesic.points[geodesic.points.size() / 2].position;
      (*seen)[r].push_back(
          {middle, std::max(0.05 * diagonal, 0.25 * geodesic.length), 4.0});
      break;
    }
    if (lifted.empty()) return {};
    for (auto k = static_cast<std::size_t>(done) + 1;
         static_cast<double>(k) < run.entry.at; ++k) {
      out.push_back(path[k]);
    }
    out.insert(out.end(), lifted.begin(), lifted.end());
    done = run.exit.at;
  }
  for (auto k = static_cast<std::size_t>(done) + 1; k < path.size(); ++k) {
    out.push_back(path[k]);
  }
  return out;
}

void StartRepair::Impl::Finish(Path path, const StartRepairOptions& options,
                               double margin, StartRepairResult* result) const {
  if (!CheckPath(space, path).free) {
    result->reason = "the lifted path is not free";
    return;
  }
  std::mt19937_64 random(options.seed);
  StraightenedPath straight = Straighten(
      space, std::move(path), {0.9 * margin, options.random_cuts}, &random);
  result->cuts_tried += straight.tried;
  result->cuts_taken += straight.taken;
  if (static_cast<int>(straight.points.size()) > options.waypoints + 2) {
    // Clearance is worth less than a path.
    straight = Straighten(space, std::move(straight.points),
                          {0.0, options.random_cuts}, &random);
  }
  Path sampled = ResampleKeepingCorners(straight.points, options.waypoints);
  if (sampled.empty()) {
    result->reason = "the path has " +
                     std::to_string(straight.points.size() - 2) +
                     " corners, more than waypoints (" +
                     std::to_string(options.waypoints) + ")";
    return;
  }
  if (!CheckPath(space, sampled).free) {
    result->reason = "the resampled path is not free";
    return;
  }
  result->routes.push_back(std::move(sampled));
}

void StartRepair::Impl::AskPlanner(const Path& path,
                                   const StartRepairOptions& options,
                                   double margin,
                                   StartRepairResult* result) const {
  if (!planner) return;
  result->asked_planner = true;
  const CompletePlan plan = planner(path.front(), path.back());
  result->settled += plan.settled;
  if (plan.infeasible) {
    result->status = RepairStatus::kInfeasibleProved;
    result->reason.clear();
  } else if (!plan.path.empty()) {
    Finish(plan.path, options, margin, result);
  } else {
    result->reason = "the complete planner found no path";
  }
}

void StartRepair::Impl::Repair(const Path& path,
                               const StartRepairOptions& options,
                               StartRepairResult* result) const {
  if (!space.IsFree(path.front())) {
    result->status = RepairStatus::kStartInCollision;
    return;
  }
  if (!space.IsFree(path.back())) {
    result->status = RepairStatus::kGoalInCollision;
    return;
  }
  const double length = options.diagonal > 0.0 ? options.diagonal : diagonal;
  const double margin = options.margin * length;
  const Runs found = FindRuns(path);
  result->runs = static_cast<int>(found.runs.size()) + (found.is_open ? 1 : 0);
  if (result->runs == 0) {
    Path sampled = ResampleKeepingCorners(path, options.waypoints);
    if (!sampled.empty() && CheckPath(space, sampled).free) {
      result->status = RepairStatus::kFree;
      result->routes.push_back(std::move(sampled));
      return;
    }
    Finish(path, options, margin, result);  // more corners than waypoints
  } else if (options.planner_only) {
    result->reason = "there is no complete planner to ask";
  } else if (found.is_open) {
    result->reason = "the path enters a component it does not leave";
  } else {
    std::vector<std::vector<DetourRegion>> seen;
    for (int route = 0; route < options.routes; ++route) {
      Path around = LeadAround(path, found.runs, margin, &seen, result);
      if (around.empty()) {
        result->reason = "no way on the surface could be lifted";
        continue;
      }
      Finish(std::move(around), options, margin, result);
    }
  }
  if (result->routes.empty()) AskPlanner(path, options, margin, result);
  if (result->routes.empty()) return;
  result->status = RepairStatus::kRepaired;
  result->reason.clear();
  std::stable_sort(result->routes.begin(), result->routes.end(),
                   [](const Path& a, const Path& b) {
                     return PathLength(a) < PathLength(b);
                   });
}

StartRepair::StartRepair(const TriangleMesh& merged_contact_mesh,
                         CompletePlanner planner)
    : impl_(std::make_unique<Impl>(merged_contact_mesh, std::move(planner))) {}
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
  if (path.size() < 2) {
    throw InputError(
        "start repair: expected a path of 2 points or more, found " +
        std::to_string(path.size()));
  }
  for (const Vector3d& q : path) {
    if (!q.allFinite()) {
      throw InputError("start repair: the path holds a non-finite point");
    }
  }
  const auto begin = std::chrono::steady_clock::now();
  StartRepairResult result;
  impl_->Repair(path, options, &result);
  result.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin)
          .count();
  return result;
}

const FreeSpace& StartRepair::space() const { return impl_->space; }
double StartRepair::diagonal() const { return impl_->diagonal; }

}  // namespace phongpd
