// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>

#include "constraints/free_space.h"
#include "core/contact/convolution_model.h"
#include "core/contact/free_space_flood.h"
#include "planners/exact/contact_surface_planner.h"

namespace phongpd {

// A plan, and what of the contact space was modelled for it.
struct WindowPlan {
  PlanResult plan;
  // The boundary of the free space that was explored, or for a proof that of
  // the cell that is enclosed; none where the straight way was enough, or start
  // or goal are not free.
  std::optional<ExploredSpace> surface;
  std::size_t boxes = 0;  // arranged
  std::size_t faces = 0;  // in their arrangements
};

// ContactSurfacePlanner without the contact space: complete, deterministic, and
// its cost is that of what lies about the path, or of the smaller of two cells
// that are not connected.
//
// Free space is explored from start and goal alternately (free_space_flood.h)
// until both meet; what was explored is bounded by C_cont and by walls, and is
// planned in as if the walls were contact.  If the two are connected, that
// gives a path, which is shortened beyond the walls in all of free space; if
// not yet, more is explored; and where all of one cell was explored, no wall is
// left, and the proof is that of ContactSurfacePlanner.  The path need not be
// the shortest kind there is: others are compared in what was explored, and a
// little more is where the first one is much tighter than its ends.
//
// Takes more than a contact space that is there already, and about 1 to 3 times
// a full build where all of free space has to be explored.
class WindowPlanner {
 public:
  // The model of all obstacles, and of bounds (MergedObstacle).  Names as in
  // ContactSurfacePlanner.  Throws InputError for options.
  explicit WindowPlanner(const ConvolutionModel& sealed,
                         const ContactSurfaceOptions& options = {},
                         ObstacleNames names = {});

  // Thread-safe.  Same arguments, same result but for `seconds`.  Throws
  // InputError for requests, BuildRefusal where one exploration passes the
  // model's limits, BuildCancelled.
  WindowPlan Plan(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  const RouteRequest& request = {}) const;

  // All of it, as the model tells.
  const FreeSpace& free_space() const { return space_; }

 private:
  // Is the straight way clear?  It is the result, to be improved, where it is
  // not and a clearance is to be kept.
  bool TryStraight(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                   const RouteRequest& request, PlanResult* result) const;
  // Until there is an answer.
  void Explore(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
               const RouteRequest& request, WindowPlan* out) const;
  void Widen(const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
             PlanResult* result) const;

  ConvolutionModel model_;
  ContactSurfaceOptions options_;
  ObstacleNames names_;
  FreeSpace space_;
};

}  // namespace phongpd
