// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/planner_id.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"

namespace phongpd {
namespace {

struct Known {
  PlannerId id;
  const char* name;
  bool retracts;  // carries samples to the contact surface
};
// In the order of help, and of the enum.
constexpr Known kPlanners[] = {
    {PlannerId::kContactSurface, "contact-surface", false},
    {PlannerId::kRetractionRrt, "retraction-rrt", true},
    {PlannerId::kRetractionForest, "retraction-forest", true},
    {PlannerId::kRrtConnect, "rrt-connect", false},
    {PlannerId::kPrm, "prm", false},
    {PlannerId::kPrmObstacleBased, "prm-obstacle-based", false},
    {PlannerId::kPrmGaussian, "prm-gaussian", false},
    {PlannerId::kPrmBridge, "prm-bridge", false},
    {PlannerId::kPrmRetraction, "prm-retraction", true}};

std::string NamesWhere(bool (*is_meant)(PlannerId)) {
  std::vector<std::string> names;
  for (const Known& known : kPlanners) {
    if (is_meant(known.id)) names.emplace_back(known.name);
  }
  return Joined(names);
}

}  // namespace

const std::vector<PlannerId>& AllPlanners() {
  static const std::vector<PlannerId> planners = [] {
    std::vector<PlannerId> all;
    for (const Known& known : kPlanners) all.push_back(known.id);
    return all;
  }();
  return planners;
}

const char* ToString(PlannerId planner) {
  return kPlanners[static_cast<std::size_t>(planner)].name;
}

std::vector<std::string> PlannerNames() {
  std::vector<std::string> names;
  for (const Known& known : kPlanners) names.emplace_back(known.name);
  return names;
}

PlannerId ParsePlanner(const std::string& text, const std::string& what) {
  for (const Known& known : kPlanners) {
    if (text == known.name) return known.id;
  }
  const std::vector<std::string> names = PlannerNames();
  throw InputError(what + ": expected one of " + Joined(names) + "; found '" +
                   text + "'" + DidYouMean(text, names));
}

bool Retracts(PlannerId planner) {
  return kPlanners[static_cast<std::size_t>(planner)].retracts;
}

bool ChecksMotionsOnly(PlannerId planner) {
  return planner != PlannerId::kContactSurface && !Retracts(planner);
}

bool SeeksClearance(PlannerId planner) { return !ChecksMotionsOnly(planner); }

void RequireSeeksClearance(PlannerId planner, const std::string& what) {
  if (SeeksClearance(planner)) return;
  throw InputError(what +
                   ": expected a planner that seeks one (contact-surface or a "
                   "retraction), found " +
                   ToString(planner));
}

std::string PlannersWithoutSurface() {
  return NamesWhere([](PlannerId planner) { return !Retracts(planner); });
}

std::string PlannersOfMotions() { return NamesWhere(ChecksMotionsOnly); }

}  // namespace phongpd
