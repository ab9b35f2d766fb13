// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/exact/planning_surface.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "constraints/free_space.h"
#include "core/mesh/finite.h"
#include "planners/exact/free_neighbors.h"
#include "planners/exact/path_centering.h"
#include "planners/exact/path_shortening.h"

namespace phongpd {

using Eigen::Vector3d;

PlanningSurface::PlanningSurface(const ContactSpace& space,
                                 const ContactSurfaceOptions& given_options,
                                 ObstacleNames names)
    : options((given_options.Validate(), given_options)),
      contact(space),
      segments(contact.bvh()),
      bounds(space.bounds()),
      neighbors(FreeNeighbors(contact.mesh())),
      cells(contact.mesh(), neighbors, segments),
      names_(std::move(names)) {
  const double infinity = std::numeric_limits<double>::infinity();
  const BoundingBox no_point = {Vector3d::Constant(infinity),
                                Vector3d::Constant(-infinity)};
  piece_bounds_.assign(cells.piece_count(), no_point);
  const TriangleMesh& mesh = contact.mesh();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    BoundingBox& box = piece_bounds_[cells.piece()[t]];
    for (const int v : mesh.triangles[t]) {
      box.min = box.min.cwiseMin(mesh.vertices[v]);
      box.max = box.max.cwiseMax(mesh.vertices[v]);
    }
  }
}

PlanResult PlanningSurface::Begin(const Vector3d& start, const Vector3d& goal,
                                  const RouteRequest& request) const {
  PlanResult result;
  result.rounding = cells.rounding();
  result.self_intersections =
      static_cast<long>(contact.space().report().self_intersections);
  result.reason = WhyInvalid("start", start);
  if (!result.reason.empty()) {
    result.status = PathStatus::kStartInCollision;
    return result;
  }
  result.reason = WhyInvalid("goal", goal);
  if (!result.reason.empty()) {
    result.status = PathStatus::kGoalInCollision;
    return result;
  }
  result.start = Locate(start);
  result.goal = Locate(goal);
  const int cell = result.start.cell;
  result.keeps_clearance = request.keeps_clearance && request.clearance > 0.0;
  result.wanted_clearance =
      request.clearance > 0.0 ? request.clearance : WantedClearance(cell);
  const bool decided = cell != FreeCells::kUndecided &&
                       result.goal.cell != FreeCells::kUndecided;
  if (decided && cell != result.goal.cell) {
    result.status = PathStatus::kInfeasibleProved;
    result.reason = "start and goal lie in different cells of free space";
  }
  return result;
}

double PlanningSurface::ClearanceOfEnds(const Vector3d& start,
                                        const Vector3d& goal,
                                        double clearance) const {
  return std::min({clearance, segments.Distance(start, start, clearance),
                   segments.Distance(goal, goal, clearance)});
}

bool PlanningSurface::IsClearWay(const Vector3d& start, const Vector3d& goal,
                                 const PlanResult& result) const {
  if (segments.Meets(start, goal)) return false;
  const double ends = ClearanceOfEnds(start, goal, result.wanted_clearance);
  return start == goal ||
         segments.Distance(start, goal, ends) >= ShareOfEnds(result) * ends;
}

void PlanningSurface::Keep(std::vector<Vector3d> raw_path, int random_cuts,
                           PlanResult* result) const {
  const double kept = result->keeps_clearance ? result->wanted_clearance : 0.0;
  CenterPath(contact, segments, LiftOf(*result), kept, &raw_path);
  ShorteningOptions shortening;
  shortening.clearance = result->wanted_clearance;
  shortening.random_cuts = random_cuts;
  std::vector<Vector3d> path =
      ShortenPath(raw_path, segments, shortening,
                  result->keeps_clearance ? 1.0 : kClearanceKept);
  Offer(std::move(raw_path), std::move(path), result);
}

void PlanningSurface::Offer(std::vector<Vector3d> raw_path,
                            std::vector<Vector3d> path,
                            PlanResult* result) const {
  result->routes.push_back(path);
  const double length = PathLength(path);
  const double clearance = ClearanceOf(path);
  if (result->status == PathStatus::kSolved) {
    const double wish =
        result->keeps_clearance ? result->wanted_clearance : 0.0;
    const RouteOrder order(cells.rounding(), wish);
    if (!order.IsBetter({length, clearance},
                        {result->length, result->clearance})) {
      return;
    }
  }
  result->status = PathStatus::kSolved;
  result->reason.clear();
  result->raw_path = std::move(raw_path);
  result->path = std::move(path);
  result->length = length;
  result->clearance = clearance;
}

double PlanningSurface::WantedClearance(int cell) const {
  const BoundingBox& hull = cell >= 0 ? piece_bounds_[cell] : bounds;
  return kEnoughClearance * hull.Diagonal();
}

double PlanningSurface::ClearanceOf(const std::vector<Vector3d>& path) const {
  double least = contact.Answer(path[0], Location::kOutside).signed_distance;
  for (std::size_t k = 1; k < path.size(); ++k) {
    least = segments.Distance(path[k - 1], path[k], least);
  }
  return least;
}

std::string PlanningSurface::WhyInvalid(const char* which,
                                        const Vector3d& q) const {
  if (!IsFinite(q) || !contact.Accepts(q)) {
    return std::string(which) + " is not finite";
  }
  const Location location = contact.Locate(q);
  if (location == Location::kOutside) return "";
  std::ostringstream reason;
  reason.precision(6);
  if (location == Location::kOnSurface) {
    reason << which << " touches";
  } else {
    reason << which << " is "
           << -contact.Answer(q, Location::kInside).signed_distance
           << " deep in";
  }
  const std::string names = names_ ? names_(q) : "";
  reason << (names.empty() ? " an obstacle" : " '" + names + "'");
  return reason.str();
}

CellCertificate PlanningSurface::Locate(const Vector3d& q) const {
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

}  // namespace phongpd
