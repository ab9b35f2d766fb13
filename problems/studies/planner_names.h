// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "planners/ompl/ompl_planning.h"

// Planners and retractions as users name them, and what each can do.
namespace phongpd {

// The complete one.
inline constexpr char kContactSurface[] = "contact-surface";
// "contact-surface" and OmplPlannerNames().
std::vector<std::string> PlannerNames();

// How retraction planners sample: "phong" (all branches), "phong-random",
// "phong-novelty", "phong-warm", "phong-nearest", "euclidean" (nearest) and
// "contact-point" (no retraction).  Throws InputError starting with `what`.
RetractionOptions ParseRetraction(const std::string& text,
                                  const std::string& what);
const std::vector<std::string>& RetractionNames();
// Throws InputError for contact-surface, which OMPL's benchmark cannot run.
void CheckHasOmplLog(const std::string& planner);
// Does the planner take a wanted clearance?  OMPL's own do not.
bool SeeksClearance(const std::string& planner);
// Throws InputError starting with `what` unless it does.
void RequireSeeksClearance(const std::string& planner, const std::string& what);

// The planners that do without the contact surface, from which they want
// nothing but validity and motion checks: SurfaceFreePlannerNames().
bool ChecksMotionsOnly(const std::string& planner);
// Those that need all of the contact surface: not those, nor contact-surface,
// which can model what of it leads from start to goal (WindowPlanner).
bool NeedsWholeSurface(const std::string& planner);

}  // namespace phongpd
