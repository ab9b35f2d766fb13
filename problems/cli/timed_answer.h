// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "planners/trajectory/curve_optimizer.h"
#include "planners/world/world.h"
#include "problems/scenes/scene.h"
#include "problems/studies/timed_trajectory.h"

// Motions in time, as optimize --limits and retime write them.
namespace phongpd::cli {

struct TimedFlags {
  std::string limits;  // V,A,J; empty: the scene's own; "none": no time
  std::string rate;    // of a CSV; empty: kDefaultRate
  std::string time_limit;
  std::string output;
  bool json = false;
  bool no_cache = false;
  bool has_margin = false;  // by a flag
  bool require = false;     // the margin
  bool verify = true;       // on the solids
  WorldLimits world;
};

// Declares --limits (`of_none` says what they are if not set) and --rate.
void AddTimed(CLI::App* app, const std::string& of_none, std::string* limits,
              std::string* rate);

// Those of the flag, or the scene's own, or none.
std::optional<MotionLimits> LimitsOf(const std::string& flag,
                                     const Scene& scene);

// Declares the output, JSON or by its name a CSV, asks for the answer, and
// writes and tells it.  Returns kDone if it is certified, kNoAnswer otherwise.
// Throws InputError for flags that make no sense before it asks.
int AnswerInTime(
    const Scene& scene, const MotionLimits& limits, const TimedFlags& flags,
    const std::function<TimedTrajectory(const World&, const CurveOptions&)>&
        ask);

}  // namespace phongpd::cli
