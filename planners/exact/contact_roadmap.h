// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>

#include "core/contact/contact_space.h"
#include "planners/exact/contact_surface_planner.h"

namespace phongpd {

// Distance between nodes on an edge, a fraction of the mesh's diagonal, in
// [1e-3, 1].  Smaller: shorter raw paths, longer build and queries.
inline constexpr double kRoadmapSpacing = 0.1;

// What can be set for one query.
struct RoadmapRequest {
  // Centre and shorten the route.  False: the route as the roadmap has it.
  bool shorten = true;
  double clearance = 0.0;  // user's unit, ≥ 0, finite; 0: kEnoughClearance

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

struct RoadmapReport {
  int nodes = 0;
  int edges = 0;
  int lowered_edges = 0;   // free only nearer to the surface than their ends
  int left_out_edges = 0;  // closed by rounding
  double build_seconds = 0.0;
  long queries = 0;        // that looked for a route
  long lazy_searches = 0;  // of those, the planner was asked
};

// ContactSurfacePlanner for many queries on one scene: its whole roadmap is
// lifted off the surface and tested once (lifted_graph.h); a query joins start
// and goal to it by exact tests and takes the cheapest route.
//
// It is as complete as the planner, with the same statuses, proofs and exact
// tests.  Infeasibility is proved by the same certificates.  A query that finds
// no route is handed to the planner; only rounding, or unusual places of start
// and goal, can cause that.  `searches` of a result is 0 if the roadmap
// answered. It takes one route, the shortest on the roadmap, where narrow
// places count up to twice.  If the best path matters more than time, ask the
// planner.
//
// Building the roadmap pays after ten to three hundred queries; for fewer,
// ContactSurfacePlanner::Plan is faster.
class ContactRoadmap {
 public:
  // On the planner's contact space, with its wanted clearance.  Throws
  // InputError for a spacing out of range and for no planner.
  explicit ContactRoadmap(std::shared_ptr<const ContactSurfacePlanner> planner,
                          double spacing = kRoadmapSpacing);
  // Builds the planner, too; throws InputError like it.
  explicit ContactRoadmap(const ContactSpace& merged,
                          const ContactSurfaceOptions& planner_options = {});
  ~ContactRoadmap();
  ContactRoadmap(ContactRoadmap&&) noexcept;
  ContactRoadmap& operator=(ContactRoadmap&&) noexcept;

  // Thread-safe.  Same arguments, same result but for `seconds`.  A start or
  // goal that is not finite is an invalid one; throws InputError for requests.
  PlanResult Plan(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  const RoadmapRequest& request = {}) const;

  RoadmapReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
