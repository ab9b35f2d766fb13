// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "planners/solve/fleet.h"
#include "planners/solve/optimize.h"
#include "planners/solve/plan.h"

// What --explain tells: what was taken for an answer, and why.
namespace phongpd::cli {

// Declares --explain.
void AddExplain(CLI::App* app, bool* explain);

// A line each of world, preset, planner, model, lengths, metric and judgement,
// 5 to 10, from the request as it was asked and the evidence of its answer.
// Each says who chose: a flag of `app`, the scene, or nobody, and what the
// program's own choice rests on.  No line has an end.
std::vector<std::string> ExplainPlan(const CLI::App& app, const World& world,
                                     const PlanRequest& request,
                                     const PathAnswer& answer);
// The same of polylines and of motions in time.
std::vector<std::string> ExplainTrajectory(const CLI::App& app,
                                           const World& world,
                                           const OptimizeRequest& request,
                                           const PathAnswer& answer);

// Of several robots: what is the same of all in one line, before what is of
// each, which begins with its name.
std::vector<std::string> ExplainFleet(const CLI::App& app,
                                      const std::vector<FleetRobot>& robots,
                                      const FleetAnswer& answer);

// On standard error.
void TellExplanation(const std::vector<std::string>& lines);

}  // namespace phongpd::cli
