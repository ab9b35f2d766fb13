// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planners/trajectory/curve_optimizer.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/timed_trajectory.h"

// Motions in time, as optimize --limits and retime write them.
namespace phongpd::cli {

// As they are given, or empty.
struct MotionWords {
  std::string limits;  // V,A,J; empty: the scene's own; "none": no time
  std::string rate;    // of a CSV; empty: kDefaultRate
  std::vector<std::string> via;  // X,Y,Z[,LENGTH[,DWELL]]
  std::string duration;
};

struct TimedFlags {
  MotionWords motion;
  std::string time_limit;
  std::string output;
  bool json = false;
  bool no_cache = false;
  bool has_margin = false;  // by a flag
  bool require = false;     // the margin
  bool verify = true;       // on the solids
  WorldLimits world;
};

// Declares --limits, --via, --duration and --rate; the other texts say what
// holds where the first, and the second and third, are not set.
void AddMotion(CLI::App* app, const std::string& without_limits,
               const std::string& without_task, MotionWords* words);

// Those of the flag, or the scene's own, or none.
std::optional<MotionLimits> LimitsOf(const MotionWords& words,
                                     const Scene& scene);

// Throws InputError where one is given that says nothing without limits.
void RequireNoMotion(const MotionWords& words);

// Places on the way and a duration that are given become the scene's.
void SetTask(const MotionWords& words, Scene* scene);

// Declares the output, JSON or by its name a CSV, asks for the answer, and
// writes and tells it.  Returns kDone if it is certified, kNoAnswer otherwise.
// Throws InputError for flags that make no sense before it asks.
int AnswerInTime(
    const Scene& scene, const MotionLimits& limits, const TimedFlags& flags,
    const std::function<TimedTrajectory(const World&, const CurveOptions&)>&
        ask);

}  // namespace phongpd::cli
