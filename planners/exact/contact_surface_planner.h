// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "planners/exact/free_cells.h"
#include "planners/world/path_status.h"
#include "planners/world/preset.h"

namespace phongpd {

struct PlanningSurface;

// What lifting routes off the surface took.
struct LiftCounts {
  int lifted = 0;    // segments of paths that became free
  int tests = 0;     // segments tested
  int halvings = 0;  // of lifts
};

// The default clearance, a share of the diagonal of the cell's hull; passages
// narrower than twice that are taken in the middle.
inline constexpr double kEnoughClearance = 0.01;

struct ContactSurfaceOptions {
  // Distance between roadmap points on an edge, a fraction of the mesh's
  // diagonal.  Smaller: shorter routes, longer searches.  In [1e-3, 1].
  double spacing = 0.05;
  // At most this many triangles, and points of edges if triangles are fewer,
  // get a link across the gap in front of them.
  int gap_links = 256;
  // Routes of different kinds that are compared after shortening, at least 1;
  // fewer where the first is about as short as the straight line.
  int routes = 3;
  int random_cuts = 200;  // of the shortening, ≥ 0

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// Writes what a preset means into default options.  Set other values
// afterwards.
void ApplyPreset(Preset preset, ContactSurfaceOptions* options);

// The name of what the robot touches at a configuration, for the reason of a
// plan: a contact space has no names.  Thread-safe; returns "" if it knows
// none.
using ObstacleNames = std::function<std::string(const Eigen::Vector3d&)>;

// What can be set for one query.
struct RouteRequest {
  double clearance = 0.0;  // user's unit, ≥ 0, finite; 0: kEnoughClearance
  // Is the clearance above 0 to be kept?  Then routes are lifted by more than
  // it, shortening gives nothing of it away, and a route that keeps it comes
  // before one that does not.  Otherwise it is what routes are lifted by.
  bool keeps_clearance = false;
  int routes = 0;  // ≥ 0; 0: by the options

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// How it is known in which cell a configuration lies; two of them in different
// cells are a proof of infeasibility.
struct CellCertificate {
  int cell = FreeCells::kUndecided;  // a shell's number or kOutside
  CellRay ray;                       // from the configuration
  std::vector<int> pieces;           // the chain, whose rays …
  std::vector<CellRay> rays;         // … are these, one per piece
};

struct PlanResult {
  PathStatus status = PathStatus::kFailed;
  std::string reason;                     // one sentence unless solved
  std::vector<Eigen::Vector3d> path;      // from start to goal, shortened
  std::vector<Eigen::Vector3d> raw_path;  // as lifted off the surface
  // All routes that were compared, shortened as `path`, which is one of them;
  // the last one may be made of parts of the others (path_recombination.h).
  std::vector<std::vector<Eigen::Vector3d>> routes;
  double length = 0.0;
  double clearance = 0.0;         // of the whole path from contact, rounded
  double wanted_clearance = 0.0;  // user's unit
  bool keeps_clearance = false;   // is that one asked to be kept?
  CellCertificate start, goal;
  // The answer holds for every surface without self-intersection that connects
  // its vertices as the mesh does, and has them within this distance of the
  // mesh's (free_cells.h).
  double rounding = 0.0;
  long self_intersections = 0;  // of the mesh, as rounded
  int searches = 0;
  int deleted_edges = 0;
  LiftCounts lift;
  double seconds = 0.0;
};

// Complete, deterministic planner for a robot that translates among solids.
//
// Free space is bounded by C_cont.  Two configurations are connected iff they
// lie in the same cell, which rays decide (free_cells.h).  The surface of a
// cell is a roadmap of it (surface_graph.h): the shortest route on the surface
// is lifted off (path_lift.h) and shortened (path_shortening.h), and the best
// parts of several routes are put together (path_recombination.h).  If an edge
// of the roadmap cannot be lifted, because rounding folded the surface there,
// it is deleted and the search is repeated.  So
//  - kSolved comes with a path all of which is free by exact tests;
//  - kInfeasibleProved with the rays that put start and goal into different
//    cells, valid for the surface within `rounding`;
//  - kFailed happens only where rounding tore the surface, or for gaps as small
//    as rounding.
// No parameter decides whether a problem is solved.
class ContactSurfacePlanner {
 public:
  // `merged` is one contact space of all obstacles and of the bounds
  // (MergedObstacle), with its cavities.  A start or goal that is not free is
  // said to be in "an obstacle" unless `names` knows better.  Throws InputError
  // for options.
  explicit ContactSurfacePlanner(const ContactSpace& merged,
                                 const ContactSurfaceOptions& options = {},
                                 ObstacleNames names = {});
  ~ContactSurfacePlanner();
  ContactSurfacePlanner(ContactSurfacePlanner&&) noexcept;
  ContactSurfacePlanner& operator=(ContactSurfacePlanner&&) noexcept;

  // Thread-safe.  Same arguments, same result but for `seconds`.  A start or
  // goal that is not finite is an invalid one; throws InputError for requests,
  // and BuildCancelled between two routes after CancelBuilds (build_stop.h).
  PlanResult Plan(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  const RouteRequest& request = {}) const;

  const FreeCells& cells() const;
  double build_seconds() const;

 private:
  friend class ContactRoadmap;
  friend class StartRepair;
  struct Impl;

  // All: as many routes as are asked for, however long; otherwise only while
  // they may become the shortest.
  PlanResult Plan(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  const RouteRequest& request, bool all_routes) const;

  const PlanningSurface& surface() const;

  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
