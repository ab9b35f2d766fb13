// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"
#include "planners/world/budget.h"

namespace phongpd {
namespace {

const BudgetFlags& FlagsFor(BudgetUse use, double seconds,
                            const Workspace& workspace) {
  RequireBudget(seconds, "budget");
  return ChoiceFor(use, TrianglesOf(workspace), seconds).flags;
}

}  // namespace

void ApplyBudget(double seconds, const Workspace& workspace,
                 PlanRequest* request) {
  const BudgetFlags& flags = FlagsFor(BudgetUse::kPlan, seconds, workspace);
  request->planner = flags.planner;
  request->model = flags.model;
  request->preset = flags.preset;
}

void ApplyBudget(double seconds, const Workspace& workspace,
                 OptimizeRequest* request) {
  const BudgetFlags& flags = FlagsFor(BudgetUse::kOptimize, seconds, workspace);
  ApplyPreset(flags.preset, request);
  request->model = flags.model;
  request->penetration.metric = flags.metric;
}

}  // namespace phongpd
