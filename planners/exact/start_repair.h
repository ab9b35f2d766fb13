// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "planners/exact/contact_surface_planner.h"

namespace phongpd {

struct StartRepairOptions {
  int waypoints = 40;  // N ≥ 1 free points between start and goal
  // Wished, user's unit, ≥ 0; 0: 0.01 of D of the contact space.
  double clearance = 0.0;
  int routes = 1;  // to return, in [1, 8]: of the best parts of 8 ways
  std::uint64_t seed = 1;

  // Throws InputError naming the option, the range and the value.
  void Validate() const;
};

using RepairStatus = PathStatus;  // old name, removed in 0.3

struct StartRepairResult {
  PathStatus status = PathStatus::kFailed;
  // waypoints + 2 points each, exactly free, the shortest first; at most
  // `routes`, none if there is no path.
  std::vector<std::vector<Eigen::Vector3d>> routes;
  std::string reason;  // one sentence unless free or repaired
  int runs = 0;        // pieces of the given path that collide
  int searches = 0;    // of the surface's roadmap
  LiftCounts lift;
  double seconds = 0.0;
};

// Turns a colliding path into an exactly free one that an optimiser can start
// from.  (Projecting every point cannot: where a path enters one side of a
// plate and leaves by the other, nearest points jump.)
//
//  1. Colliding run: from just before the first contact to just after a place
//     where the path is free again, the next one that can be reached.
//  2. It becomes the shortest path on the contact space, lifted to the
//     clearance or to the middle of the gap and shortened
//     (contact_surface_planner.h).
//     For a path of two points that is the whole path.
//  3. The joined path is shortened again and resampled with every corner a
//     waypoint (path_resampling.h).
//
// As complete as the planner: it gives a path, or the proof that none exists,
// or the reason why rounding left neither.  For a path of two points, further
// routes are the next ones that the planner compared; equal routes are given
// once.
class StartRepair {
 public:
  // The boundary of the union of all that is in the way, bounds included
  // (MergedObstacle): overlapping contact spaces must be merged first.  Throws
  // InputError for options.
  explicit StartRepair(const ContactSpace& merged,
                       const ContactSurfaceOptions& planner_options = {});
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
  double diagonal() const;  // D of the contact space

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
