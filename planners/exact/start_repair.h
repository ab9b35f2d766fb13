// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "planners/exact/free_space.h"

namespace phongpd {

struct StartRepairOptions {
  int waypoints = 40;     // N ≥ 1 free points between start and goal
  double margin = 0.01;   // wished clearance, a fraction of `diagonal`, > 0
  double diagonal = 0.0;  // user's unit; 0: that of the contact mesh
  int routes = 1;         // ways around each obstacle to look for, in [1, 8]
  int random_cuts = 120;  // of the straightening
  bool planner_only = false;  // the complete planner's path, not the surface's
  std::uint64_t seed = 1;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

struct LiftCounters {
  int lifted = 0;   // points lifted off the surface
  int lowered = 0;  // times a lift was halved
};

enum class RepairStatus {
  kFree,              // the given path was free; resampled only
  kRepaired,          // exactly free now
  kInfeasibleProved,  // no path exists: start and goal lie in different cells
  kFailed,            // see `reason`
  kStartInCollision,
  kGoalInCollision,
};
const char* ToString(RepairStatus status);

struct StartRepairResult {
  RepairStatus status = RepairStatus::kFailed;
  // waypoints + 2 points each, exactly free, the shortest first; one if free
  // or repaired with routes = 1, none if there is no path.
  std::vector<std::vector<Eigen::Vector3d>> routes;
  std::string reason;  // of a failure; empty otherwise
  int runs = 0;        // pieces of the given path that collide
  int settled = 0;     // nodes closed by the geodesic searches
  LiftCounters lift;
  int cuts_tried = 0;
  int cuts_taken = 0;
  bool asked_planner = false;
  double seconds = 0.0;

  bool HasPath() const { return !routes.empty(); }
};

// What a complete planner says when the surface shows no way.
struct CompletePlan {
  bool infeasible = false;            // proved
  std::vector<Eigen::Vector3d> path;  // exactly free; empty: none found
  int settled = 0;
};
using CompletePlanner = std::function<CompletePlan(
    const Eigen::Vector3d& start, const Eigen::Vector3d& goal)>;

// Turns a colliding path into an exactly free one that an optimiser can start
// from.  (Projecting every point cannot: where a path enters one side of a
// plate and leaves by the other, nearest points jump.)
//
//  1. Colliding run: from the first contact with a surface component to the
//     next place where the path leaves that component into free space.
//  2. It becomes a short path on the contact space (surface_geodesic.h) ...
//  3. ... lifted by min(margin, half the gap) along the normals and pushed up
//     the distance gradient until the clearance is the margin where it can be.
//     Where a lifted segment still collides, its middle is lifted too, or the
//     larger of its two lifts halved.
//  4. The whole path is straightened (path_straightening.h), keeping 0.9
//     margins of clearance or what there was, and resampled with every corner
//     a waypoint.
//
// A run that does not come back to its component, and a lift that fails, are
// given to the complete planner if there is one.
class StartRepair {
 public:
  // The boundary of the union of all that is in the way, bounds included
  // (MergedObstacle): overlapping contact spaces must be merged first.  As
  // FreeSpace requires it; throws InputError.
  explicit StartRepair(const TriangleMesh& merged_contact_mesh,
                       CompletePlanner planner = nullptr);
  ~StartRepair();
  StartRepair(StartRepair&&) noexcept;
  StartRepair& operator=(StartRepair&&) noexcept;

  // From the straight line, or any polyline of at least two points.  Throws
  // InputError for a shorter or non-finite one.  Deterministic.
  StartRepairResult Repair(const Eigen::Vector3d& start,
                           const Eigen::Vector3d& goal,
                           const StartRepairOptions& options = {}) const;
  StartRepairResult Repair(const std::vector<Eigen::Vector3d>& path,
                           const StartRepairOptions& options = {}) const;

  const FreeSpace& space() const;
  double diagonal() const;  // of the contact mesh

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
