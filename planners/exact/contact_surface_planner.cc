// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/contact_surface_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <set>
#include <sstream>

#include "core/mesh/segment_tree.h"
#include "core/mesh/self_intersection.h"
#include "core/projection/contact_surface.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/exact/free_space.h"
#include "planners/exact/path_centering.h"
#include "planners/exact/path_recombination.h"
#include "planners/exact/path_shortening.h"
#include "planners/exact/surface_graph.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Further routes are not looked for if one is hardly longer than the straight
// line and as clear as the ends allow, nor where they are so much longer than
// the shortest that no part of them will serve.
constexpr double kStraight = 1.05, kHopeless = 3.0;
constexpr int kNarrowRoutes = 3;  // if straight but not clear

// Recombined routes keep this share of the clearance of their parts, and count
// if they are shorter than this share of the shortest part.
constexpr double kKeptShare = 0.8, kGain = 0.99;

template <typename T>
void Require(bool holds, const char* option, const char* range, T value) {
  CheckOption(holds, "contact-surface planner", option, range, value);
}

}  // namespace

const char* ToString(PlanStatus status) {
  switch (status) {
    case PlanStatus::kSolved:
      return "solved";
    case PlanStatus::kInfeasibleProved:
      return "infeasible_proved";
    case PlanStatus::kFailed:
      return "failed";
    case PlanStatus::kInvalidStart:
      return "invalid_start";
    case PlanStatus::kInvalidGoal:
      return "invalid_goal";
  }
  return "";
}

void ContactSurfaceOptions::Validate() const {
  Require(clearance > 0.0 && clearance <= 0.5, "clearance", "in (0, 0.5]",
          clearance);
  Require(spacing >= 1e-3 && spacing <= 1.0, "spacing", "in [0.001, 1]",
          spacing);
  Require(gap_links >= 0, "gap_links", "≥ 0", gap_links);
  Require(max_searches >= 1, "max_searches", "≥ 1", max_searches);
  Require(routes >= 1, "routes", "≥ 1", routes);
  Require(random_cuts >= 0, "random_cuts", "≥ 0", random_cuts);
}

void PlanRequest::Validate() const {
  Require(clearance >= 0.0 && std::isfinite(clearance), "clearance",
          "≥ 0 and finite", clearance);
  Require(routes >= 0, "routes", "≥ 0", routes);
}

struct ContactSurfacePlanner::Impl {
  Impl(const TriangleMesh& contact_mesh,
       const ContactSurfaceOptions& given_options)
      : options((given_options.Validate(), given_options)),
        surface(contact_mesh),
        segments(surface.mesh()),
        bounds(ComputeBounds(surface.mesh())),
        neighbors(TriangleNeighbors(surface.mesh())),
        cells(surface.mesh(), neighbors, segments),
        graph(surface.mesh(), neighbors, segments, cells,
              options.spacing * bounds.Diagonal(), options.gap_links),
        piece_bounds(cells.piece_count(), NoPoint()) {
    const TriangleMesh& mesh = surface.mesh();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      BoundingBox& box = piece_bounds[cells.piece()[t]];
      for (const int v : mesh.triangles[t]) {
        box.min = box.min.cwiseMin(mesh.vertices[v]);
        box.max = box.max.cwiseMax(mesh.vertices[v]);
      }
    }
    self_intersections = options.self_intersections;
  }

  static BoundingBox NoPoint() {
    const double infinity = std::numeric_limits<double>::infinity();
    return {Vector3d::Constant(infinity), Vector3d::Constant(-infinity)};
  }

  std::string WhyInvalid(const char* which, const Vector3d& q) const;
  CellCertificate Locate(const Vector3d& q) const;
  std::vector<Attachment> Attach(const Vector3d& q, const Vector3d& other,
                                 bool to_goal,
                                 const CellCertificate& certificate) const;
  void FindPath(const Vector3d& start, const Vector3d& goal,
                const PlanRequest& request, PlanResult* result) const;
  void Keep(std::vector<Vector3d> raw_path, PlanResult* result) const;
  void Recombine(PlanResult* result) const;
  double ClearanceOf(const std::vector<Vector3d>& path) const;
  long CountSelfIntersections() const;

  ContactSurfaceOptions options;
  ContactSurface surface;
  SegmentTree segments;
  BoundingBox bounds;
  std::vector<std::array<int, 3>> neighbors;
  FreeCells cells;
  SurfaceGraph graph;
  std::vector<BoundingBox> piece_bounds;
  double build_seconds = 0.0;
  mutable std::once_flag counted;
  mutable long self_intersections = -1;
};

std::string ContactSurfacePlanner::Impl::WhyInvalid(const char* which,
                                                    const Vector3d& q) const {
  std::ostringstream reason;
  reason.precision(6);
  if (!q.allFinite() || !surface.Accepts(q)) {
    reason << which << " is not finite";
    return reason.str();
  }
  const Location location = surface.Locate(q);
  if (location == Location::kOutside) return "";
  if (location == Location::kOnSurface) {
    reason << which << " touches";
  } else {
    reason << which << " is "
           << -surface.Answer(q, Location::kInside).signed_distance
           << " deep in";
  }
  const std::string name =
      options.name_obstacle ? options.name_obstacle(q) : "";
  reason << (name.empty() ? " an obstacle" : " '" + name + "'");
  return reason.str();
}

CellCertificate ContactSurfacePlanner::Impl::Locate(const Vector3d& q) const {
  CellCertificate certificate;
  certificate.cell = cells.CellOf(q, &certificate.ray);
  if (certificate.ray.to_triangle >= 0) {
    certificate.pieces =
        cells.Chain(cells.piece()[certificate.ray.to_triangle]);
    for (const int piece : certificate.pieces) {
      certificate.rays.push_back(cells.rays()[piece]);
    }
  }
  return certificate;
}

// The closest point, what is met on the way to the other configuration and in
// a few directions, and the ray that told the cell.
std::vector<Attachment> ContactSurfacePlanner::Impl::Attach(
    const Vector3d& q, const Vector3d& other, bool to_goal,
    const CellCertificate& certificate) const {
  std::vector<Attachment> attachments;
  const auto add = [&](const Vector3d& point, int triangle) {
    Attachment attachment;
    attachment.to_goal = to_goal;
    attachment.site.point = point;
    attachment.site.triangle = triangle;
    // At edges and corners only the way back to q is free for sure.
    attachment.site.direction = (q - point).stableNormalized();
    attachments.push_back(attachment);
  };
  const PenetrationResult closest = surface.Answer(q, Location::kOutside);
  add(closest.contact, closest.triangle);
  const auto shoot = [&](const Vector3d& to) {
    const SegmentTree::Hit hit = segments.FirstHit(q, to);
    if (hit.Found()) add(q + hit.fraction * (to - q), hit.triangle);
  };
  shoot(other);
  const double reach = bounds.Diagonal() + (q - bounds.Center()).norm();
  for (int code = 0; code < 27; ++code) {
    if (code == 13) continue;
    const Vector3d direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    shoot(q + reach * direction.normalized());
  }
  if (certificate.ray.to_triangle >= 0) {
    add(certificate.ray.to, certificate.ray.to_triangle);
  } else if (certificate.cell == FreeCells::kOutside) {
    Attachment attachment;
    attachment.to_goal = to_goal;
    attachment.outside = true;
    attachment.site.point = certificate.ray.to;
    attachments.push_back(attachment);
  }
  return attachments;
}

// Of a path that is free, at most what it has at its start.
double ContactSurfacePlanner::Impl::ClearanceOf(
    const std::vector<Vector3d>& path) const {
  double least = surface.Answer(path[0], Location::kOutside).signed_distance;
  for (std::size_t k = 1; k < path.size(); ++k) {
    least = segments.Distance(path[k - 1], path[k], least);
  }
  return least;
}

// Makes a free path the result unless that is better already.
void ContactSurfacePlanner::Impl::Keep(std::vector<Vector3d> raw_path,
                                       PlanResult* result) const {
  CenterPath(surface, segments, result->wanted_clearance, &raw_path);
  ShorteningOptions shortening;
  shortening.clearance = result->wanted_clearance;
  shortening.random_cuts = options.random_cuts;
  shortening.seed = options.seed;
  std::vector<Vector3d> path = ShortenPath(raw_path, segments, shortening);
  result->routes.push_back(path);
  const double length = PathLength(path);
  const double clearance = ClearanceOf(path);
  if (result->status == PlanStatus::kSolved) {
    // Clearance is worth a tenth of the length.
    const double share = clearance < 0.7 * result->clearance ? 0.9 : 1.0;
    if (length >= share * result->length) return;
  }
  result->status = PlanStatus::kSolved;
  result->reason.clear();
  result->raw_path = std::move(raw_path);
  result->path = std::move(path);
  result->length = length;
  result->clearance = clearance;
}

// One more route, of the best parts of those found.
void ContactSurfacePlanner::Impl::Recombine(PlanResult* result) const {
  if (result->routes.size() < 2) return;
  std::vector<RoutedPath> paths;
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::vector<Vector3d>& route : result->routes) {
    const double clearance = kKeptShare * ClearanceOf(route);
    paths.push_back({route, std::min(clearance, result->wanted_clearance)});
    shortest = std::min(shortest, PathLength(route));
  }
  std::vector<Vector3d> path = RecombinePaths(paths, segments);
  if (PathLength(path) < kGain * shortest) Keep(std::move(path), result);
}

void ContactSurfacePlanner::Impl::FindPath(const Vector3d& start,
                                           const Vector3d& goal,
                                           const PlanRequest& request,
                                           PlanResult* result) const {
  const bool all = request.all_routes;
  const int routes = request.routes > 0 ? request.routes : options.routes;
  // Straight, if that is free and as clear as the ends allow.
  const bool sees = !segments.Meets(start, goal);
  const double ends =
      std::min({result->wanted_clearance,
                segments.Distance(start, start, result->wanted_clearance),
                segments.Distance(goal, goal, result->wanted_clearance)});
  if (sees) {
    if (start == goal || segments.Distance(start, goal, ends) >= 0.4 * ends) {
      std::vector<Vector3d> path = {start};
      if (start != goal) path.push_back(goal);
      return Keep(std::move(path), result);
    }
  }
  std::vector<Attachment> attachments =
      Attach(start, goal, false, result->start);
  const std::vector<Attachment> to_goal =
      Attach(goal, start, true, result->goal);
  attachments.insert(attachments.end(), to_goal.begin(), to_goal.end());
  const int count = static_cast<int>(graph.sites().size());
  const int end = count + static_cast<int>(attachments.size());
  std::set<SurfaceGraph::Edge> deleted;
  std::vector<char> avoided;
  const double straight = (goal - start).norm();
  for (int found = 0; found < routes;) {
    if (result->searches == options.max_searches) break;
    ++result->searches;
    const SurfaceGraph::Route route =
        graph.Search(start, goal, attachments, deleted, avoided);
    if (route.empty()) break;
    std::vector<SurfaceSite> sites(1);
    sites[0].point = start;
    for (const int i : route) {
      sites.push_back(i < count ? graph.sites()[i]
                                : attachments[i - count].site);
    }
    sites.emplace_back();
    sites.back().point = goal;
    std::vector<Vector3d> path;
    const int blocked = LiftRoute(sites, segments, result->wanted_clearance,
                                  cells.rounding(), &path, &result->lift);
    if (blocked >= 0) {
      const int before = blocked == 0 ? -1 : route[blocked - 1];
      const int after =
          blocked < static_cast<int>(route.size()) ? route[blocked] : end;
      deleted.insert(std::minmax(before, after));
      result->deleted_edges = static_cast<int>(deleted.size());
      continue;
    }
    // A route this long will not become the shortest one.
    if (!all && found > 0 && PathLength(path) > kHopeless * result->length) {
      break;
    }
    Keep(std::move(path), result);
    ++found;
    if (!all && result->length < kStraight * straight &&
        (result->clearance >= 0.4 * ends || found >= kNarrowRoutes)) {
      break;
    }
    avoided.resize(neighbors.size(), 0);
    for (const SurfaceSite& site : sites) {
      if (site.triangle >= 0) avoided[site.triangle] = 1;
    }
  }
  if (result->status == PlanStatus::kSolved) return Recombine(result);
  const bool decided = result->start.cell != FreeCells::kUndecided &&
                       result->goal.cell != FreeCells::kUndecided;
  result->reason =
      result->searches == options.max_searches
          ? "no route could be lifted in as many searches as allowed"
      : decided ? "every route on the surface has a place that rounding closed"
                : "no route found, and no ray that keeps rounding away from "
                  "edges tells the cell of the start or of the goal";
  if (sees) Keep({start, goal}, result);
}

long ContactSurfacePlanner::Impl::CountSelfIntersections() const {
  std::call_once(counted, [&] {
    if (self_intersections >= 0) return;
    const std::vector<int> one_label(surface.mesh().triangles.size(), 0);
    self_intersections = static_cast<long>(
        internal::CountSelfIntersections(surface.mesh(), one_label));
  });
  return self_intersections;
}

ContactSurfacePlanner::ContactSurfacePlanner(
    const TriangleMesh& merged_contact_mesh,
    const ContactSurfaceOptions& options) {
  const Stopwatch stopwatch;
  impl_ = std::make_unique<Impl>(merged_contact_mesh, options);
  impl_->build_seconds = stopwatch.Seconds();
}

ContactSurfacePlanner::~ContactSurfacePlanner() = default;
ContactSurfacePlanner::ContactSurfacePlanner(ContactSurfacePlanner&&) noexcept =
    default;
ContactSurfacePlanner& ContactSurfacePlanner::operator=(
    ContactSurfacePlanner&&) noexcept = default;

const FreeCells& ContactSurfacePlanner::cells() const { return impl_->cells; }
double ContactSurfacePlanner::build_seconds() const {
  return impl_->build_seconds;
}

PlanResult ContactSurfacePlanner::Plan(const Vector3d& start,
                                       const Vector3d& goal,
                                       const PlanRequest& request) const {
  request.Validate();
  const Stopwatch stopwatch;
  const Impl& impl = *impl_;
  PlanResult result;
  result.rounding = impl.cells.rounding();
  result.self_intersections = impl.options.self_intersections;
  result.reason = impl.WhyInvalid("start", start);
  if (!result.reason.empty()) {
    result.status = PlanStatus::kInvalidStart;
  } else {
    result.reason = impl.WhyInvalid("goal", goal);
    if (!result.reason.empty()) result.status = PlanStatus::kInvalidGoal;
  }
  if (result.reason.empty()) {
    result.start = impl.Locate(start);
    result.goal = impl.Locate(goal);
    const int cell = result.start.cell;
    const BoundingBox& hull = cell >= 0 ? impl.piece_bounds[cell] : impl.bounds;
    result.wanted_clearance = request.clearance > 0.0
                                  ? request.clearance
                                  : impl.options.clearance * hull.Diagonal();
    const bool decided = cell != FreeCells::kUndecided &&
                         result.goal.cell != FreeCells::kUndecided;
    if (decided && cell != result.goal.cell) {
      result.status = PlanStatus::kInfeasibleProved;
      result.reason = "start and goal lie in different cells of free space";
      result.self_intersections = impl.CountSelfIntersections();
    } else {
      impl.FindPath(start, goal, request, &result);
    }
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

}  // namespace phongpd
