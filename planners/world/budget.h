// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planners/world/model.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/planner_id.h"
#include "planners/world/preset.h"
#include "planners/world/workspace.h"

// What a budget of time buys: the table that results/trade/budget.md publishes.
namespace phongpd {

enum class BudgetUse { kPlan, kOptimize };

// What to ask for.  Only contact-surface and the optimiser have presets, only
// the optimiser a metric.
struct BudgetFlags {
  Model model = Model::kAuto;
  Preset preset = Preset::kBalanced;
  PlannerId planner = PlannerId::kContactSurface;  // of kPlan
  MetricKind metric = MetricKind::kPhong;          // of kOptimize
};
// As phongpd plan or optimize takes it: "--model window --preset fast".  Left
// out are a planner and a metric by default, and the preset of other planners.
std::string ToString(const BudgetFlags& flags);

// A cell of the table.
struct BudgetChoice {
  BudgetUse use = BudgetUse::kPlan;
  std::size_t triangles = 0;  // about, of robot and obstacles together
  double seconds = 0.0;       // of processors, builds included
  // Of all that were measured the ones that answered most problems within the
  // time; of equals the shortest paths at equal clearance, then the quickest.
  BudgetFlags flags;
  int answered = 0, problems = 0;  // within the time
};
const std::vector<BudgetChoice>& BudgetChoices();

// The cell for so many triangles, the nearest by ratio, and seconds > 0, the
// most that are no more than these, or the least there are.  Throws InputError
// for more triangles than √10 times the most that were measured.
const BudgetChoice& ChoiceFor(BudgetUse use, std::size_t triangles,
                              double seconds);

// Of the robot and the obstacles within its reach.
std::size_t TrianglesOf(const Workspace& workspace);

// Throws InputError starting with `what` unless seconds are finite and > 0.
void RequireBudget(double seconds, const std::string& what);

}  // namespace phongpd
