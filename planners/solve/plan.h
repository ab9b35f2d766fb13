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
  // What the planner seeks where there is room, in (0, D]; none: its own, 0.01
  // of the diagonal of the space it plans in (kEnoughClearance,
  // RetractionOptions).
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

// Writes what was measured to answer most often within so many seconds of
// processors, builds included, for as many triangles: planner, model, preset
// (results/trade/budget.md).  It limits nothing: time limits do.  A planner
// that samples proves nothing where there is no path.  Set other values
// afterwards. Throws InputError unless seconds are finite and > 0.
void ApplyBudget(double seconds, const Workspace& workspace,
                 PlanRequest* request);

// Plans in a world.  The world builds what the planner needs on the first
// request, and keeps it.  If start or goal is not free, the answer says so
// before anything is built.  Every path is judged exactly, and again after it
// was shortened (ShortenPath, for planners that only check motions).
//
// Throws InputError for bad requests, and for Model::kWindow with a planner
// that needs the whole contact surface; BuildRefusal if limits of the world do
// not allow what is needed.  Thread-safe, except that samplers reseed OMPL's
// own generator, which all threads share (OmplPlanningOptions).
//
// Contact-surface keeps a clearance that is given wherever it finds a way to.
PathAnswer Plan(const World& world, const PlanRequest& request);

// The same for who makes the clearance later: contact-surface's routes are
// lifted by it, and shortening gives a part of it away.
PathAnswer PlanLifted(const World& world, const PlanRequest& request);

// One sentence if start or goal has less than the clearance asked for; else
// empty.  Builds nothing.
std::string ClearanceBeyondReach(const World& world,
                                 const PlanRequest& request);

// Will the request be answered in the window?  Builds the whole model if there
// is no other way to know.
bool PlansInWindow(const World& world, const PlanRequest& request);

// Where a path can be: within the bounds, or in the box around the cells of
// start and goal (SamplingRegion).  Builds what the request needs.
BoundingBox PlanningRegion(const World& world, const PlanRequest& request);

// Where a path is searched for if only free space is modelled: within the
// bounds, or in the box around start, goal and all obstacles (SamplingRegion).
BoundingBox WindowRegion(const World& world, const Eigen::Vector3d& start,
                         const Eigen::Vector3d& goal);

// The log of OMPL's own benchmark of one of its planners, for the statistics
// script that comes with OMPL.  Throws like Plan, and for contact-surface.
std::string OmplLog(const World& world, const PlanRequest& request, int runs);

}  // namespace phongpd
