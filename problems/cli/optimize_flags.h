// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "planners/trajectory/trajectory_pipeline.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/world.h"
#include "problems/cli/motion_words.h"
#include "problems/cli/seeded_runs.h"

// What users say to phongpd optimize.
namespace phongpd::cli {

struct OptimizeFlags : SeededRunFlags {
  std::string budget;
  std::string preset;
  std::string metric;
  std::string smoothing_length;
  std::string margin;
  std::string jacobian;
  std::string start = "repaired";
  std::string mu_strategy = "adaptive";
  std::string polish;
  std::string noise = "0";
  MotionWords motion;
  int routes = 0;  // the preset's
  int rows = TrajectoryOptions().rows;
  bool line = true;
  bool per_obstacle = false;
  bool require = false;
  std::string model;
  WorldLimits limits;
  bool verify = true;
  bool explain = false;
};

// Declare what keeps a path out of obstacles and away from them, where the
// optimiser begins, how it gets on from there, and where the answer goes; a
// motion in time has other files than a path.
void AddMetricFlags(CLI::App* app, OptimizeFlags* flags);
void AddStartFlags(CLI::App* app, OptimizeFlags* flags);
void AddSolverFlags(CLI::App* app, OptimizeFlags* flags);
void AddOutputFlags(CLI::App* app, OptimizeFlags* flags);

}  // namespace phongpd::cli
