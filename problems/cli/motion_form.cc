// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/motion_form.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"
#include "planners/trajectory/least_duration.h"
#include "problems/cli/flags.h"

namespace phongpd::cli {
namespace {

constexpr double kDefaultRate = 100.0;  // Hz
constexpr double kMostRate = 1e6;

// FILE.multidof.yaml.
bool IsMultiDof(const std::string& output) {
  const std::string stem = std::filesystem::path(output).stem().string();
  return EndingOf(stem) == ".multidof";
}

}  // namespace

const std::vector<std::string>& MotionEndings() {
  static const std::vector<std::string> endings = {".json", ".jsonl", ".csv",
                                                   ".yaml", ".gcode", ".nc"};
  return endings;
}

bool IsRos(MotionForm form) {
  return form == MotionForm::kRos || form == MotionForm::kRosMultiDof;
}

bool HasRate(MotionForm form) {
  return form == MotionForm::kCsv || IsRos(form);
}

MotionForm MotionFormOf(const TimedFlags& flags) {
  if (FormOf(flags.output, flags.json) == AnswerForm::kCsv) {
    return MotionForm::kCsv;
  }
  const std::string ending = EndingOf(flags.output);
  const MotionForm form =
      ending == ".yaml" ? IsMultiDof(flags.output) ? MotionForm::kRosMultiDof
                                                   : MotionForm::kRos
      : ending == ".gcode" || ending == ".nc" ? MotionForm::kGcode
                                              : MotionForm::kJson;
  if (flags.json && form != MotionForm::kJson) {
    throw InputError("--json: expected --output FILE.json, found " +
                     flags.output);
  }
  return form;
}

double RateOf(const TimedFlags& flags) {
  const std::string& text = flags.motion.rate;
  if (text.empty()) return kDefaultRate;
  const double rate = ParseDouble(text, "--rate");
  if (!(rate > 0.0 && rate <= kMostRate)) {
    throw InputError("--rate: expected a number above 0 and at most " +
                     FormatDouble(kMostRate) + " (Hz), found " + text);
  }
  if (!HasRate(MotionFormOf(flags))) {
    throw InputError(
        "--rate: expected --output FILE.csv or FILE.yaml, which it is the rate "
        "of, found " +
        (flags.output.empty() ? "none" : flags.output));
  }
  return rate;
}

// Also what is asked for, and rests on the way.
double LeastDuration(const OptimizeRequest& request) {
  double least =
      std::max(request.duration,
               phongpd::LeastDuration(
                   request.goal - request.start, *request.limits,
                   request.departure.IsAtRest() && request.arrival.IsAtRest()));
  for (const Via& via : request.via) least += std::max(0.0, via.dwell);
  return least;
}

void RequireClock(MotionForm form, const std::string& output,
                  const std::string& what) {
  if (form != MotionForm::kGcode) return;
  throw InputError(
      "--output: expected FILE.csv or FILE.yaml, which have "
      "times, with " +
      what + ", found " + output +
      "; a machine may be late by G-code, and meet what moves");
}

void ApplyTimedFlags(const TimedFlags& flags, const Scene& scene,
                     OptimizeRequest* request) {
  // Also where it is what it would be without the flag.
  if (flags.has_margin) request->margin = scene.trajectory.margin;
  request->requires_margin = flags.require;
  request->verifies = flags.verify;
  if (flags.routes) request->options.routes = *flags.routes;
  if (!flags.time_limit.empty()) {
    request->options.time_limit = ParseDouble(flags.time_limit, "--time");
  }
}

}  // namespace phongpd::cli
