// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "planners/solve/optimize.h"
#include "problems/cli/timed_answer.h"

// How motions in time are written: of one robot (timed_answer.h) and of several
// (fleet_answer.h).
namespace phongpd::cli {

// By the name of the output.
enum class MotionForm { kJson, kCsv, kRos, kRosMultiDof, kGcode };

// Of names of outputs.
const std::vector<std::string>& MotionEndings();

bool IsRos(MotionForm form);
bool HasRate(MotionForm form);

// Throws InputError where --json meets a name of another form.
MotionForm MotionFormOf(const TimedFlags& flags);

// Rows a second.  Throws InputError for a --rate that is out of range, or of an
// output without one.
double RateOf(const TimedFlags& flags);

// Which no motion from start to goal is shorter than, with the request's
// limits.
double LeastDuration(const OptimizeRequest& request);

// G-code has feeds and no clock: a machine that is late meets what moves.
// Throws InputError where that is asked for.
void RequireClock(MotionForm form, const std::string& output,
                  const std::string& what);

// What the flags say of every request, beside its scene.
void ApplyTimedFlags(const TimedFlags& flags, const Scene& scene,
                     OptimizeRequest* request);

}  // namespace phongpd::cli
