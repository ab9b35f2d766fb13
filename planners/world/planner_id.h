// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// All planners, by their names.
enum class PlannerId {
  // Complete, deterministic, proves that there is no path
  // (contact_surface_planner.h, window_planner.h).
  kContactSurface,
  // This library's, on retractions.
  kRetractionRrt,
  kRetractionForest,
  // OMPL's, with uniform samples and, by PRM, its samplers for narrow passages.
  kRrtConnect,
  kPrm,
  kPrmObstacleBased,
  kPrmGaussian,
  kPrmBridge,
  kPrmRetraction,  // PRM with this library's RetractionStateSampler
};
const std::vector<PlannerId>& AllPlanners();

// "contact-surface", "rrt-connect", …
const char* ToString(PlannerId planner);
std::vector<std::string> PlannerNames();
// Throws InputError starting with `what`, with all names.
PlannerId ParsePlanner(const std::string& text, const std::string& what);

// Does it want nothing but validity and motion checks?  Then free space alone
// is enough (Model::kWindow).
bool ChecksMotionsOnly(PlannerId planner);
// Does it carry samples to the contact surface (retraction.h)?  Then it needs
// all of that.  contact-surface can model what of it leads from start to goal
// (WindowPlanner).
bool Retracts(PlannerId planner);
// Does it seek a wanted clearance?  OMPL's own do not.
bool SeeksClearance(PlannerId planner);
// Throws InputError starting with `what` unless it does.
void RequireSeeksClearance(PlannerId planner, const std::string& what);
// Those that do not retract, "a, b, c": for messages.
std::string PlannersWithoutSurface();
// Those that only check motions, in the same form.
std::string PlannersOfMotions();

}  // namespace phongpd
