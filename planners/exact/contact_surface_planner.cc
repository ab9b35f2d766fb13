// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/contact_surface_planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "constraints/free_space.h"
#include "core/minkowski/build_stop.h"
#include "core/stopwatch.h"
#include "planners/exact/check_option.h"
#include "planners/exact/path_lift.h"
#include "planners/exact/path_recombination.h"
#include "planners/exact/planning_surface.h"
#include "planners/exact/surface_graph.h"
#include "planners/exact/surface_sight.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Further routes are not looked for if one is hardly longer than the straight
// line and as clear as the ends allow, nor where they are so much longer than
// the shortest that no part of them will serve.
constexpr double kStraight = 1.05, kHopeless = 3.0;
constexpr int kNarrowRoutes = 3;  // if straight but not clear

// Searches after edges that could not be lifted.
constexpr int kMaxSearches = 200;

// Routes as lifted that differ by less, of their length, are one.
constexpr double kSameWay = 0.01;

// Recombined routes keep this share of the clearance of their parts, and count
// if they are shorter than this share of the shortest part.
constexpr double kKeptShare = 0.8, kGain = 0.99;

bool IsKnown(const std::vector<std::vector<Vector3d>>& raw_paths,
             const std::vector<Vector3d>& path) {
  return std::any_of(
      raw_paths.begin(), raw_paths.end(),
      [&](const auto& other) { return TakeSameWay(other, path, kSameWay); });
}

template <typename T>
void RequireOfPlanner(bool holds, const char* option, const char* range,
                      T value) {
  CheckOption(holds, "contact-surface planner", option, range, value);
}

// Of a result that is not solved.
const char* WhyNoRoute(const PlanResult& result) {
  if (result.searches == kMaxSearches) {
    return "no route could be lifted in as many searches as allowed";
  }
  const bool decided = result.start.cell != FreeCells::kUndecided &&
                       result.goal.cell != FreeCells::kUndecided;
  return decided ? "every route on the surface has a place that rounding closed"
                 : "no route found, and no ray that keeps rounding away from "
                   "edges tells the cell of the start or of the goal";
}

}  // namespace

void ContactSurfaceOptions::Validate() const {
  RequireOfPlanner(spacing >= 1e-3 && spacing <= 1.0, "spacing",
                   "in [0.001, 1]", spacing);
  RequireOfPlanner(gap_links >= 0, "gap_links", "≥ 0", gap_links);
  RequireOfPlanner(routes >= 1, "routes", "≥ 1", routes);
  RequireOfPlanner(random_cuts >= 0, "random_cuts", "≥ 0", random_cuts);
}

void ApplyPreset(Preset preset, ContactSurfaceOptions* options) {
  // The first route alone; nor does a link across a gap find another.
  if (preset == Preset::kFast) {
    options->routes = 1;
    options->gap_links = 0;
  }
  if (preset == Preset::kTight) {
    options->routes = 8;
    options->spacing = 0.2;
  }
}

void RouteRequest::Validate() const {
  RequireOfPlanner(clearance >= 0.0 && std::isfinite(clearance), "clearance",
                   "≥ 0 and finite", clearance);
  RequireOfPlanner(routes >= 0, "routes", "≥ 0", routes);
}

struct ContactSurfacePlanner::Impl {
  Impl(const ContactSpace& space, const ContactSurfaceOptions& options,
       ObstacleNames names)
      : surface(space, options, std::move(names)),
        graph(surface.contact.mesh(), surface.neighbors, surface.segments,
              surface.cells, options.spacing * surface.bounds.Diagonal(),
              options.gap_links) {}

  class RouteSearch;

  std::vector<Attachment> Attach(const Vector3d& q, const Vector3d& other,
                                 bool to_goal,
                                 const CellCertificate& certificate) const;
  void Keep(std::vector<Vector3d> raw_path, PlanResult* result) const {
    surface.Keep(std::move(raw_path), surface.options.random_cuts, result);
  }
  void Recombine(PlanResult* result) const;
  void FindPath(const Vector3d& start, const Vector3d& goal,
                const RouteRequest& request, bool all,
                PlanResult* result) const;

  PlanningSurface surface;
  SurfaceGraph graph;
  double build_seconds = 0.0;
};

// The closest point, what is met on the way to the other configuration and in
// a few directions, and the ray that told the cell: it alone would do, the
// others make routes shorter.
std::vector<Attachment> ContactSurfacePlanner::Impl::Attach(
    const Vector3d& q, const Vector3d& other, bool to_goal,
    const CellCertificate& certificate) const {
  std::vector<Attachment> attachments;
  const auto add = [&](const Vector3d& point, int triangle) {
    const std::optional<SurfaceSite> site =
        SiteSeenFrom(q, point, triangle, surface.contact.mesh(),
                     surface.segments, surface.cells.rounding());
    if (!site) return;
    Attachment attachment;
    attachment.to_goal = to_goal;
    attachment.site = *site;
    attachments.push_back(attachment);
  };
  const PenetrationResult closest =
      surface.contact.Answer(q, Location::kOutside);
  add(closest.contact, closest.triangle);
  const auto shoot = [&](const Vector3d& to) {
    const TriangleBvh::Hit hit = surface.segments.FirstHit(q, to);
    if (hit.Found()) add(q + hit.fraction * (to - q), hit.triangle);
  };
  shoot(other);
  const double reach =
      surface.bounds.Diagonal() + (q - surface.bounds.Center()).norm();
  for (int code = 0; code < 27; ++code) {
    if (code == 13) continue;
    const Vector3d direction(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    shoot(q + reach * direction.normalized());
  }
  if (certificate.ray.to_triangle >= 0) {
    add(certificate.ray.to, certificate.ray.to_triangle);
  } else if (certificate.cell == FreeCells::kOutside &&
             surface.cells.IsAbove(certificate.ray.to)) {
    Attachment attachment;
    attachment.to_goal = to_goal;
    attachment.outside = true;
    attachment.site.point = certificate.ray.to;
    attachments.push_back(attachment);
  }
  return attachments;
}

// One more route, of the best parts of those found.
void ContactSurfacePlanner::Impl::Recombine(PlanResult* result) const {
  if (result->routes.size() < 2) return;
  const double share = result->keeps_clearance ? 1.0 : kKeptShare;
  std::vector<RoutedPath> paths;
  double shortest = std::numeric_limits<double>::infinity();
  for (const std::vector<Vector3d>& route : result->routes) {
    const double clearance = share * surface.ClearanceOf(route);
    paths.push_back({route, std::min(clearance, result->wanted_clearance)});
    shortest = std::min(shortest, PathLength(route));
  }
  std::vector<Vector3d> path = RecombinePaths(paths, surface.segments);
  if (PathLength(path) < kGain * shortest) Keep(std::move(path), result);
}

// Searches the roadmap, lifts what is found, and searches again: without the
// edges that could not be lifted, or around the routes that are known.
class ContactSurfacePlanner::Impl::RouteSearch {
 public:
  // `all` as in Plan.  All outlive this.
  RouteSearch(const Impl& planner, const Vector3d& start, const Vector3d& goal,
              const RouteRequest& request, bool all, PlanResult* result)
      : planner_(planner),
        start_(start),
        goal_(goal),
        takes_known_(request.routes > 0),
        routes_(takes_known_ ? request.routes : planner.surface.options.routes),
        all_(all),
        result_(*result),
        site_count_(static_cast<int>(planner.graph.sites().size())),
        attachments_(planner.Attach(start, goal, false, result->start)),
        straight_((goal - start).norm()) {
    const std::vector<Attachment> to_goal =
        planner.Attach(goal, start, true, result->goal);
    attachments_.insert(attachments_.end(), to_goal.begin(), to_goal.end());
    clear_ =
        PlanningSurface::ShareOfEnds(*result) *
        planner.surface.ClearanceOfEnds(start, goal, result->wanted_clearance);
  }

  // Throws BuildCancelled.
  void Run() {
    while (found_ < routes_) {
      watch_.Check("the search for routes");
      if (result_.searches == kMaxSearches) break;
      ++result_.searches;
      const SurfaceGraph::Route route = planner_.graph.Search(
          start_, goal_, attachments_, deleted_, avoided_);
      if (route.empty()) break;
      const std::vector<SurfaceSite> sites = SitesOf(route);
      std::vector<Vector3d> path;
      const std::vector<int> blamed = LiftRoute(
          sites, planner_.surface.segments, PlanningSurface::LiftOf(result_),
          planner_.surface.cells.rounding(), &path, &result_.lift);
      if (!blamed.empty()) {
        Delete(blamed, route);
        continue;
      }
      if (IsHopeless(path)) break;
      ++found_;
      KeepIfWanted(std::move(path));
      if (IsEnough()) break;
      Avoid(sites);
    }
  }

 private:
  // From the start to the goal, both included.
  std::vector<SurfaceSite> SitesOf(const SurfaceGraph::Route& route) const {
    std::vector<SurfaceSite> sites(1);
    sites[0].point = start_;
    for (const int i : route) {
      sites.push_back(i < site_count_ ? planner_.graph.sites()[i]
                                      : attachments_[i - site_count_].site);
    }
    sites.emplace_back();
    sites.back().point = goal_;
    return sites;
  }

  // The edges of a route that are to blame, from now on.
  void Delete(const std::vector<int>& blamed,
              const SurfaceGraph::Route& route) {
    const int end = site_count_ + static_cast<int>(attachments_.size());
    for (const int k : blamed) {
      const int before = k == 0 ? -1 : route[k - 1];
      const int after = k < static_cast<int>(route.size()) ? route[k] : end;
      deleted_.insert(std::minmax(before, after));
    }
    result_.deleted_edges = static_cast<int>(deleted_.size());
  }

  // A route this long will not become the shortest one.
  bool IsHopeless(const std::vector<Vector3d>& path) const {
    return !all_ && planner_.surface.IsCertain(result_.clearance) &&
           PathLength(path) > kHopeless * result_.length;
  }

  // One that is known is not worth shortening once more; who asks for more
  // routes wants even that.
  void KeepIfWanted(std::vector<Vector3d> path) {
    if (!takes_known_ && IsKnown(raw_paths_, path)) return;
    raw_paths_.push_back(path);
    planner_.Keep(std::move(path), &result_);
  }

  // Is the best route about straight, and clear or as good as narrow ways get?
  bool IsEnough() const {
    return !all_ && planner_.surface.IsCertain(result_.clearance) &&
           result_.length < kStraight * straight_ &&
           (result_.clearance >= clear_ || found_ >= kNarrowRoutes);
  }

  // So that the next route is one of another kind.
  void Avoid(const std::vector<SurfaceSite>& sites) {
    avoided_.resize(planner_.surface.neighbors.size(), 0);
    for (const SurfaceSite& site : sites) {
      if (site.triangle >= 0) avoided_[site.triangle] = 1;
    }
  }

  const CancelWatch watch_;
  const Impl& planner_;
  const Vector3d start_, goal_;
  const bool takes_known_;
  const int routes_;
  const bool all_;
  PlanResult& result_;
  const int site_count_;  // of the graph; attachments are numbered after them
  std::vector<Attachment> attachments_;
  const double straight_;
  double clear_ = 0.0;
  std::set<SurfaceGraph::Edge> deleted_;
  std::vector<char> avoided_;  // triangles
  std::vector<std::vector<Vector3d>> raw_paths_;
  int found_ = 0;
};

void ContactSurfacePlanner::Impl::FindPath(const Vector3d& start,
                                           const Vector3d& goal,
                                           const RouteRequest& request,
                                           bool all, PlanResult* result) const {
  if (surface.IsClearWay(start, goal, *result)) {
    std::vector<Vector3d> path = {start};
    if (start != goal) path.push_back(goal);
    return Keep(std::move(path), result);
  }
  RouteSearch(*this, start, goal, request, all, result).Run();
  const bool is_found = result->status == PathStatus::kSolved;
  if (is_found) Recombine(result);
  if (is_found && !result->keeps_clearance) return;
  if (!is_found) result->reason = WhyNoRoute(*result);
  if (!surface.segments.Meets(start, goal)) Keep({start, goal}, result);
}

ContactSurfacePlanner::ContactSurfacePlanner(
    const ContactSpace& merged, const ContactSurfaceOptions& options,
    ObstacleNames names) {
  const Stopwatch stopwatch;
  impl_ = std::make_unique<Impl>(merged, options, std::move(names));
  impl_->build_seconds = stopwatch.Seconds();
}

ContactSurfacePlanner::~ContactSurfacePlanner() = default;
ContactSurfacePlanner::ContactSurfacePlanner(ContactSurfacePlanner&&) noexcept =
    default;
ContactSurfacePlanner& ContactSurfacePlanner::operator=(
    ContactSurfacePlanner&&) noexcept = default;

const FreeCells& ContactSurfacePlanner::cells() const {
  return surface().cells;
}
const PlanningSurface& ContactSurfacePlanner::surface() const {
  return impl_->surface;
}
double ContactSurfacePlanner::build_seconds() const {
  return impl_->build_seconds;
}

PlanResult ContactSurfacePlanner::Plan(const Vector3d& start,
                                       const Vector3d& goal,
                                       const RouteRequest& request) const {
  return Plan(start, goal, request, false);
}

PlanResult ContactSurfacePlanner::Plan(const Vector3d& start,
                                       const Vector3d& goal,
                                       const RouteRequest& request,
                                       bool all_routes) const {
  request.Validate();
  const Stopwatch stopwatch;
  PlanResult result = impl_->surface.Begin(start, goal, request);
  if (result.reason.empty()) {
    impl_->FindPath(start, goal, request, all_routes, &result);
  }
  result.seconds = stopwatch.Seconds();
  return result;
}

}  // namespace phongpd
