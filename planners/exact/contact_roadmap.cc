// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/contact_roadmap.h"

#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "constraints/free_space.h"
#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/exact/lifted_graph.h"
#include "planners/exact/path_shortening.h"
#include "planners/exact/planning_surface.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Triangles, and points of edges if triangles are fewer, that get a link across
// the gap in front of them.
constexpr int kGapLinks = 1000;
// A start or goal joins kStops of the nodes it sees among the kNeighbors
// nearest ones, and as many near what it meets first on the straight way to
// the other.
constexpr int kNeighbors = 32;
constexpr int kStops = 6;
constexpr int kShorteningCuts = 20;  // of the shortening

template <typename T>
void RequireOfRoadmap(bool holds, const char* option, const char* range,
                      T value) {
  CheckOption(holds, "contact roadmap", option, range, value);
}

}  // namespace

void RoadmapRequest::Validate() const {
  RequireOfRoadmap(clearance >= 0.0 && std::isfinite(clearance), "clearance",
                   "≥ 0 and finite", clearance);
}

struct ContactRoadmap::Impl {
  Impl(std::shared_ptr<const ContactSurfacePlanner> given_planner,
       const PlanningSurface& given_surface, double spacing)
      : planner(std::move(given_planner)),
        surface(given_surface),
        graph(surface, spacing * surface.bounds.Diagonal(), kGapLinks) {}

  std::vector<Vector3d> Route(const Vector3d& start, const Vector3d& goal,
                              double clearance) const;

  // Memory of searches, one for every query that runs at the same time.
  std::unique_ptr<RouteTable::Scratch> Take() const {
    const std::lock_guard<std::mutex> lock(mutex);
    if (idle.empty()) return std::make_unique<RouteTable::Scratch>();
    std::unique_ptr<RouteTable::Scratch> scratch = std::move(idle.back());
    idle.pop_back();
    return scratch;
  }
  void Return(std::unique_ptr<RouteTable::Scratch> scratch) const {
    const std::lock_guard<std::mutex> lock(mutex);
    idle.push_back(std::move(scratch));
  }

  std::shared_ptr<const ContactSurfacePlanner> planner;
  const PlanningSurface& surface;
  LiftedGraph graph;
  double build_seconds = 0.0;
  mutable std::atomic<long> queries{0}, lazy_searches{0};
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<RouteTable::Scratch>> idle;
};

std::vector<Vector3d> ContactRoadmap::Impl::Route(const Vector3d& start,
                                                  const Vector3d& goal,
                                                  double clearance) const {
  const auto attach = [&](const Vector3d& q, const Vector3d& other) {
    std::vector<LiftedGraph::Stop> stops;
    graph.See(q, q, clearance, kNeighbors, kStops, &stops);
    // And what is in the way: the nearest nodes may lie behind.
    const TriangleBvh::Hit hit = surface.segments.FirstHit(q, other);
    if (hit.Found()) {
      graph.See(q, q + hit.fraction * (other - q), clearance, kNeighbors,
                kStops, &stops);
    }
    if (stops.empty()) stops = graph.Descend(q, clearance, kStops);
    return stops;
  };
  std::unique_ptr<RouteTable::Scratch> scratch = Take();
  std::vector<Vector3d> route = graph.Search(
      start, attach(start, goal), goal, attach(goal, start), scratch.get());
  Return(std::move(scratch));
  return route;
}

ContactRoadmap::ContactRoadmap(
    std::shared_ptr<const ContactSurfacePlanner> planner, double spacing) {
  if (!planner) {
    throw InputError("contact roadmap: expected a planner, found none");
  }
  RequireOfRoadmap(spacing >= 1e-3 && spacing <= 1.0, "spacing",
                   "in [0.001, 1]", spacing);
  const Stopwatch stopwatch;
  const PlanningSurface& surface = planner->surface();
  impl_ = std::make_unique<Impl>(std::move(planner), surface, spacing);
  impl_->build_seconds = stopwatch.Seconds();
}

ContactRoadmap::ContactRoadmap(const ContactSpace& merged,
                               const ContactSurfaceOptions& planner_options)
    : ContactRoadmap(std::make_shared<const ContactSurfacePlanner>(
          merged, planner_options)) {}

ContactRoadmap::~ContactRoadmap() = default;
ContactRoadmap::ContactRoadmap(ContactRoadmap&&) noexcept = default;
ContactRoadmap& ContactRoadmap::operator=(ContactRoadmap&&) noexcept = default;

RoadmapReport ContactRoadmap::report() const {
  const LiftedGraph::Counts& counts = impl_->graph.counts();
  RoadmapReport report;
  report.nodes = counts.nodes;
  report.edges = counts.ways;
  report.lowered_edges = counts.lowered;
  report.left_out_edges = counts.left_out;
  report.build_seconds = impl_->build_seconds;
  report.queries = impl_->queries;
  report.lazy_searches = impl_->lazy_searches;
  return report;
}

PlanResult ContactRoadmap::Plan(const Vector3d& start, const Vector3d& goal,
                                const RoadmapRequest& request) const {
  request.Validate();
  const Stopwatch stopwatch;
  const PlanningSurface& surface = impl_->surface;
  RouteRequest wish;
  wish.clearance = request.clearance;
  wish.keeps_clearance = request.clearance > 0.0;
  PlanResult result = surface.Begin(start, goal, wish);
  if (result.reason.empty()) {
    ++impl_->queries;
    std::vector<Vector3d> path;
    if (start == goal) {
      path = {start};
    } else if (surface.IsClearWay(start, goal, result)) {
      path = {start, goal};
    } else {
      path = impl_->Route(start, goal, result.wanted_clearance);
    }
    if (path.empty()) {
      ++impl_->lazy_searches;
      result = impl_->planner->Plan(start, goal, wish);
    } else if (request.shorten) {
      // Without the points between which it is straight anyway: each of those
      // left is centred.
      ShorteningOptions sparse;
      sparse.clearance = PlanningSurface::LiftOf(result);
      sparse.random_cuts = 0;
      sparse.pulls = 0;
      surface.Keep(ShortenPath(path, surface.segments, sparse), kShorteningCuts,
                   &result);
      result.raw_path = std::move(path);
    } else {
      surface.Offer(path, path, &result);
    }
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

}  // namespace phongpd
