// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

#include "planners/solve/path_answer.h"

namespace phongpd {

// A path from start to goal, whatever its length.
struct PlanRequest {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  PlannerId planner = PlannerId::kContactSurface;
  Model model = Model::kAuto;
  // Sought where there is room, in (0, D]; none: the planner's own, 0.01 of the
  // diagonal of what it plans in (kEnoughClearance, RetractionOptions).
  std::optional<Length> clearance{};
  bool requires_clearance = false;  // less is no answer
  // Of contact-surface.
  Preset preset = Preset::kBalanced;
  int routes = 0;  // ways that are compared; 0: the preset's
  // Of samplers.
  double time_limit = 5.0;         // seconds, in (0, 1e9]
  RetractionOptions retraction{};  // metric and choice, of those that retract
  std::uint64_t seed = 1;
  bool verifies = true;  // on the original solids as well (verification.h)

  // Throws InputError naming the field.
  void Validate() const;
};

// Plans in a world, which builds what the planner needs on the first request
// and keeps it.  A start or goal that is not free is said before anything is
// built.  Every path is judged exactly; one that is shortened (ShortenPath: of
// planners that only check motions) is judged again.
//
// Throws InputError for bad requests and for a planner that needs all of the
// contact surface with Model::kWindow; BuildRefusal where limits of the world
// refuse what is needed.  Thread-safe, but that samplers reseed OMPL's own
// generator, which all share (OmplPlanningOptions).
PathAnswer Plan(const World& world, const PlanRequest& request);

// One sentence where start or goal have less than the clearance asked for;
// empty otherwise.  Builds nothing.
std::string ClearanceBeyondReach(const World& world,
                                 const PlanRequest& request);

// Will the request be answered in the window?  Builds the whole model where it
// takes that to know.
bool PlansInWindow(const World& world, const PlanRequest& request);

// Where its path can be: the bounds, or the box around the cells of start and
// goal (SamplingRegion).  Builds what the request needs.
BoundingBox PlanningRegion(const World& world, const PlanRequest& request);

// Where a path is looked for if free space is all that is modelled: the bounds,
// or the box around start, goal and all obstacles (SamplingRegion).
BoundingBox WindowRegion(const World& world, const Eigen::Vector3d& start,
                         const Eigen::Vector3d& goal);

// The log of OMPL's own benchmark of one of its planners, for the statistics
// script that comes with OMPL.  Throws like Plan, and for contact-surface.
std::string OmplLog(const World& world, const PlanRequest& request, int runs);

}  // namespace phongpd
