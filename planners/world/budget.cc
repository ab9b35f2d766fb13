// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/budget.h"

#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {

// Written by results/bench/budget_report.py --code; a test compares it with the
// table that is published.
const std::vector<BudgetChoice>& BudgetChoices() {
  constexpr BudgetUse kPlan = BudgetUse::kPlan,
                      kOptimize = BudgetUse::kOptimize;
  // clang-format off
  static const std::vector<BudgetChoice> choices = {
      {kPlan, 1000, 0.01, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 8},
      {kPlan, 1000, 0.1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 8, 8},
      {kPlan, 1000, 1, {Model::kFull, Preset::kTight}, 8, 8},
      {kPlan, 1000, 10, {Model::kFull, Preset::kTight}, 8, 8},
      {kPlan, 10000, 0.01, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 5},
      {kPlan, 10000, 0.1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 1, 5},
      {kPlan, 10000, 1, {Model::kWindow, Preset::kBalanced}, 5, 5},
      {kPlan, 10000, 10, {Model::kFull, Preset::kTight}, 5, 5},
      {kPlan, 100000, 0.01, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 4},
      {kPlan, 100000, 0.1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 4},
      {kPlan, 100000, 1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 2, 4},
      {kPlan, 100000, 10, {Model::kWindow, Preset::kBalanced}, 4, 4},
      {kPlan, 1000000, 0.01, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 4},
      {kPlan, 1000000, 0.1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 4},
      {kPlan, 1000000, 1, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 0, 4},
      {kPlan, 1000000, 10, {Model::kWindow, Preset::kBalanced, PlannerId::kRrtConnect}, 2, 4},
      {kOptimize, 1000, 0.01, {Model::kWindow, Preset::kFast, PlannerId::kContactSurface, MetricKind::kEuclidean}, 0, 8},
      {kOptimize, 1000, 0.1, {Model::kWindow, Preset::kFast, PlannerId::kContactSurface, MetricKind::kEuclidean}, 7, 8},
      {kOptimize, 1000, 1, {Model::kWindow, Preset::kBalanced, PlannerId::kContactSurface, MetricKind::kEuclidean}, 8, 8},
      {kOptimize, 1000, 10, {Model::kWindow, Preset::kBalanced, PlannerId::kContactSurface, MetricKind::kEuclidean}, 8, 8},
      {kOptimize, 10000, 0.01, {Model::kWindow, Preset::kBalanced}, 0, 5},
      {kOptimize, 10000, 0.1, {Model::kWindow, Preset::kBalanced}, 0, 5},
      {kOptimize, 10000, 1, {Model::kWindow, Preset::kBalanced, PlannerId::kContactSurface, MetricKind::kEuclidean}, 5, 5},
      {kOptimize, 10000, 10, {Model::kWindow, Preset::kBalanced, PlannerId::kContactSurface, MetricKind::kEuclidean}, 5, 5},
      {kOptimize, 100000, 0.01, {Model::kWindow, Preset::kFast}, 0, 4},
      {kOptimize, 100000, 0.1, {Model::kWindow, Preset::kFast}, 0, 4},
      {kOptimize, 100000, 1, {Model::kWindow, Preset::kFast}, 2, 4},
      {kOptimize, 100000, 10, {Model::kWindow, Preset::kFast}, 4, 4},
      {kOptimize, 1000000, 0.01, {Model::kWindow, Preset::kFast}, 0, 4},
      {kOptimize, 1000000, 0.1, {Model::kWindow, Preset::kFast}, 0, 4},
      {kOptimize, 1000000, 1, {Model::kWindow, Preset::kFast}, 0, 4},
      {kOptimize, 1000000, 10, {Model::kWindow, Preset::kFast}, 2, 4},
  };
  // clang-format on
  return choices;
}

const BudgetChoice& ChoiceFor(BudgetUse use, std::size_t triangles,
                              double seconds) {
  const auto apart = [triangles](const BudgetChoice& choice) {
    return std::abs(
        std::log(static_cast<double>(triangles > 0 ? triangles : 1) /
                 static_cast<double>(choice.triangles)));
  };
  // Before or in place of the best so far.
  const auto is_better = [&](const BudgetChoice& a, const BudgetChoice& b) {
    if (apart(a) != apart(b)) return apart(a) < apart(b);
    const bool is_enough = a.seconds <= seconds;
    if (is_enough != (b.seconds <= seconds)) return is_enough;
    return is_enough ? a.seconds > b.seconds : a.seconds < b.seconds;
  };
  const BudgetChoice* best = nullptr;
  for (const BudgetChoice& choice : BudgetChoices()) {
    if (choice.use != use) continue;
    if (best == nullptr || is_better(choice, *best)) best = &choice;
  }
  constexpr double kBeyond = 3.2;  // √10: half way to the next size
  if (static_cast<double>(triangles) >
      kBeyond * static_cast<double>(best->triangles)) {
    throw InputError("budget: expected at most " +
                     FormatDouble(std::floor(
                         kBeyond * static_cast<double>(best->triangles))) +
                     " triangles of robot and obstacles, as nothing larger was "
                     "measured, found " +
                     std::to_string(triangles) +
                     "; choose preset and model (docs/choosing.md)");
  }
  return *best;
}

std::size_t TrianglesOf(const Workspace& workspace) {
  std::size_t count = workspace.robot.mesh().triangles.size();
  for (const int i : ReachableObstacles(workspace)) {
    count += workspace.obstacles[static_cast<std::size_t>(i)]
                 .mesh()
                 .triangles.size();
  }
  return count;
}

std::string ToString(const BudgetFlags& flags) {
  const std::string model = std::string("--model ") + ToString(flags.model);
  if (flags.planner != BudgetFlags().planner) {
    return std::string("--planner ") + ToString(flags.planner) + ' ' + model;
  }
  const std::string text = model + " --preset " + ToString(flags.preset);
  return flags.metric == BudgetFlags().metric
             ? text
             : text + " --metric " + ToString(flags.metric);
}

void RequireBudget(double seconds, const std::string& what) {
  if (std::isfinite(seconds) && seconds > 0.0) return;
  throw InputError(what + ": expected seconds, finite and > 0, found " +
                   FormatDouble(seconds));
}

}  // namespace phongpd
