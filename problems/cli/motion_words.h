// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/trajectory.h"
#include "planners/world/via.h"
#include "problems/scenes/scene.h"

// What users say of a motion in time: the flags of optimize and retime.
namespace phongpd::cli {

// As they are given, or empty.
struct MotionWords {
  std::string limits;  // V,A,J; empty: the scene's own; "none": no time
  std::string rate;    // of a CSV; empty: kDefaultRate
  std::vector<std::string> via;  // X,Y,Z[,LENGTH[,DWELL]]
  std::string duration;
  std::string departure, arrival;  // VX,VY,VZ[,AX,AY,AZ]
};

// Declares --limits, --via, --duration, --departure, --arrival and --rate; the
// other texts say what holds where the first, and the second and third, are not
// set.
void AddMotion(CLI::App* app, const std::string& without_limits,
               const std::string& without_task, MotionWords* words);

// Those of the flag, or the scene's own, or none.
std::optional<MotionLimits> LimitsOf(const MotionWords& words,
                                     const Scene& scene);

// Throws InputError where one is given that says nothing without limits.
void RequireNoMotion(const MotionWords& words);

// Places on the way, a duration and ends that are given become the scene's.
void SetTask(const MotionWords& words, Scene* scene);

// Reads "V,A,J", limits of velocity, acceleration and jerk: each one number,
// of all axes, or x/y/z; or "V,A,J,norm", of their norms.  Throws InputError
// starting with `what` for anything else, and for numbers that are not above 0.
MotionLimits ParseLimits(const std::string& text, const std::string& what,
                         const std::string& unit = "");

// Reads "X,Y,Z[,LENGTH[,DWELL]]", a place on the way, LENGTH as ParseClearance
// does.  Throws InputError starting with `what`.
Via ParseVia(const std::string& text, const std::string& what, double diagonal,
             const std::string& unit);

// Reads "VX,VY,VZ[,AX,AY,AZ]", how a motion begins or ends.  Throws InputError
// starting with `what`.
CurveEnd ParseCurveEnd(const std::string& text, const std::string& what);

}  // namespace phongpd::cli
