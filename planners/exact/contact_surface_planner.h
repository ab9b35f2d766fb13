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

// Clearance that is enough for who names none, a share of the diagonal of the
// cell's hull; passages narrower than twice that are taken in the middle.
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

// What the preset sets in options that are as they come.  Whoever wants
// another value sets it afterwards.
void ApplyPreset(Preset preset, ContactSurfaceOptions* options);

// What the robot touches at a configuration, for the reasons of a plan: a
// contact space knows no names.  Thread-safe; empty for nothing it knows.
using ObstacleNames = std::function<std::string(const Eigen::Vector3d&)>;

// What one query may ask differently.
struct RouteRequest {
  double clearance = 0.0;  // user's unit, ≥ 0, finite; 0: kEnoughClearance
  int routes = 0;          // ≥ 0; 0: by the options

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

// What a proof of infeasibility rests on, and what tells the cell otherwise.
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
  // All that were compared, as `path` is, which is one of them; the last one
  // may be made of parts of the others (path_recombination.h).
  std::vector<std::vector<Eigen::Vector3d>> routes;
  double length = 0.0;
  double clearance = 0.0;         // of the whole path from contact, rounded
  double wanted_clearance = 0.0;  // user's unit
  CellCertificate start, goal;
  // Answers hold for every embedded surface of the mesh's connectivity with
  // vertices within this distance of the mesh's (free_cells.h).
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
// lie in the same cell, which rays decide (free_cells.h), and the surface
// itself is a roadmap of every cell (surface_graph.h): the shortest route on
// it is lifted off (path_lift.h), then shortened (path_shortening.h), and the
// best parts of several are put together (path_recombination.h).  An edge
// of the roadmap that cannot be lifted because rounding folded the surface is
// deleted and the search repeated.  So
//  - kSolved comes with a path all of which is free by exact tests;
//  - kInfeasibleProved with the rays that put start and goal into different
//    cells, valid for the surface within `rounding`;
//  - kFailed is for surfaces that rounding tore, or gaps of its size.
// There is no parameter that decides whether a problem is solved.
class ContactSurfacePlanner {
 public:
  // The one contact space of all obstacles, and of bounds (MergedObstacle),
  // cavities included.  Without names, or where they know none, a start or
  // goal that is not free is in "an obstacle".  Throws InputError for options.
  explicit ContactSurfacePlanner(const ContactSpace& merged,
                                 const ContactSurfaceOptions& options = {},
                                 ObstacleNames names = {});
  ~ContactSurfacePlanner();
  ContactSurfacePlanner(ContactSurfacePlanner&&) noexcept;
  ContactSurfacePlanner& operator=(ContactSurfacePlanner&&) noexcept;

  // Thread-safe.  Same arguments, same result but for `seconds`.  A start or
  // goal that is not finite is an invalid one; throws InputError for requests.
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
