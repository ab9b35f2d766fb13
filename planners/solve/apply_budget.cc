// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "planners/world/budget.h"

namespace phongpd {
namespace {

const BudgetChoice& ChoiceOf(BudgetUse use, double seconds,
                             const Workspace& workspace) {
  RequireBudget(seconds, "budget");
  return ChoiceFor(use, TrianglesOf(workspace), seconds);
}

}  // namespace

void ApplyBudget(double seconds, const Workspace& workspace,
                 PlanRequest* request) {
  const BudgetChoice& choice = ChoiceOf(BudgetUse::kPlan, seconds, workspace);
  const std::string planner = FlagOf(choice, "planner"),
                    preset = FlagOf(choice, "preset");
  request->planner = planner.empty() ? PlannerId::kContactSurface
                                     : ParsePlanner(planner, "planner");
  request->model = ParseModel(FlagOf(choice, "model"), "model");
  request->preset =
      preset.empty() ? Preset::kBalanced : ParsePreset(preset, "preset");
}

void ApplyBudget(double seconds, const Workspace& workspace,
                 OptimizeRequest* request) {
  const BudgetChoice& choice =
      ChoiceOf(BudgetUse::kOptimize, seconds, workspace);
  ApplyPreset(ParsePreset(FlagOf(choice, "preset"), "preset"), request);
  request->model = ParseModel(FlagOf(choice, "model"), "model");
  const std::string metric = FlagOf(choice, "metric");
  request->penetration.metric = metric.empty()
                                    ? PenetrationSpec().metric
                                    : ParseMetricKind(metric, "metric");
}

}  // namespace phongpd
