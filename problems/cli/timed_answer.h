// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "planners/solve/optimize.h"
#include "problems/cli/motion_words.h"
#include "problems/scenes/scene.h"

// Motions in time, as optimize --limits and retime write them.
namespace phongpd::cli {

struct TimedFlags {
  MotionWords motion;
  std::string time_limit;
  std::string output;
  std::string html;
  std::string serve_command;  // of its page; empty: none
  bool json = false;
  bool no_cache = false;
  std::optional<int> routes;  // the preset's if none
  bool has_margin = false;    // by a flag
  bool require = false;       // the margin
  bool verify = true;         // on the solids
  WorldLimits world;
};

// Of a scene with limits: declares the output, JSON or by its name a table or
// lines, and the page, asks for the answer (Optimize, Retime), and writes and
// tells it. Returns kDone if it is certified, kNoAnswer otherwise.  Throws
// InputError for flags that make no sense before it asks.
int AnswerInTime(
    const Scene& scene, const TimedFlags& flags,
    const std::function<PathAnswer(const World&, const OptimizeRequest&)>& ask);

// What to ask where a motion takes more than ten minutes that nobody asked for:
// limits in metres of a scene in millimetres make such.  Empty: nothing.
std::string SlownessNote(const std::string& unit,
                         const OptimizeRequest& request,
                         const PathAnswer& answer);

}  // namespace phongpd::cli
