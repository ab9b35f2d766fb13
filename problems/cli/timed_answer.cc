// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/timed_answer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "files/interruption.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_requests.h"
#include "problems/studies/answer_row.h"
#include "problems/studies/motion_file.h"
#include "viewer/run_view.h"
#include "viewer/scene_view.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

using Eigen::Vector3d;
using TimedJson = nlohmann::ordered_json;

constexpr double kDefaultRate = 100.0;  // Hz
constexpr double kMostRate = 1e6;

// By the name of the output.
enum class MotionForm { kJson, kCsv, kRos, kRosMultiDof, kGcode };

const std::vector<std::string> kMotionEndings = {".json", ".jsonl", ".csv",
                                                 ".yaml", ".gcode", ".nc"};

bool IsRos(MotionForm form) {
  return form == MotionForm::kRos || form == MotionForm::kRosMultiDof;
}

// FILE.multidof.yaml.
bool IsMultiDof(const std::string& output) {
  const std::string stem = std::filesystem::path(output).stem().string();
  return EndingOf(stem) == ".multidof";
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
  const MotionForm form = MotionFormOf(flags);
  if (form != MotionForm::kCsv && !IsRos(form)) {
    throw InputError(
        "--rate: expected --output FILE.csv or FILE.yaml, which it is the rate "
        "of, found " +
        (flags.output.empty() ? "none" : flags.output));
  }
  return rate;
}

// Which no motion from start to goal is shorter than: per axis, or along the
// line with limits of the norm, at its velocity v all the time; from rest to
// rest half of it at acceleration a, half at −a, or at jerk j, −j, j by 1 : 2
// : 1.  And what is asked for, and rests on the way.
double LeastDuration(const OptimizeRequest& request) {
  const MotionLimits& limits = *request.limits;
  const Vector3d way = request.goal - request.start;
  const bool has_rests =
      request.departure.IsAtRest() && request.arrival.IsAtRest();
  double least = request.duration;
  for (int k = 0; k < (limits.by_norm ? 1 : 3); ++k) {
    const double d = limits.by_norm ? way.norm() : std::abs(way[k]);
    least = std::max(least, d / limits.velocity[k]);
    if (!has_rests) continue;
    least = std::max({least, 2.0 * std::sqrt(d / limits.acceleration[k]),
                      std::cbrt(32.0 * d / limits.jerk[k])});
  }
  for (const Via& via : request.via) least += std::max(0.0, via.dwell);
  return least;
}

std::string Percent(double share) { return Rounded(100.0 * share) + " %"; }

std::string MotionText(MotionForm form, const World& world,
                       const PathAnswer& answer, const TimedJson& row,
                       double rate) {
  // A machine reads no status: it gets answers only.
  const Trajectory motion = answer.is_solved ? answer.motion : Trajectory();
  const std::string& unit = world.workspace().unit;
  switch (form) {
    case MotionForm::kCsv:
      return TimedCsv(motion, rate);
    case MotionForm::kRos:
      return RosTrajectory(motion, rate, unit);
    case MotionForm::kRosMultiDof:
      return RosMultiDofTrajectory(motion, rate, unit);
    case MotionForm::kGcode:
      return MotionGcode(*world.Convolution().free_space, motion, unit);
    case MotionForm::kJson:
      break;
  }
  return JsonText(row) + '\n';
}

// For people.
std::string TimedSentence(const Scene& scene, const PathAnswer& answer) {
  const std::string more =
      answer.reason.empty() ? "\n" : "; " + answer.reason + "\n";
  const std::string status = ToString(answer.status);
  if (answer.motion.empty()) {
    return scene.name + ": no trajectory, " + status + more;
  }
  const std::string& unit = scene.workspace.unit;
  const LimitUse& use = answer.evidence.use;
  return scene.name + ": " + Rounded(answer.motion.duration(), 6) + " s, " +
         (answer.is_free ? "certified" : "not certified") + ", " + status +
         ", clearance " + Rounded(answer.clearance) +
         (unit.empty() ? "unit" : unit) + " at least; of the limits " +
         Percent(use.velocity) + " of velocity, " + Percent(use.acceleration) +
         " of acceleration, " + Percent(use.jerk) + " of jerk" + more;
}

}  // namespace

int AnswerInTime(const Scene& scene, const TimedFlags& flags,
                 const std::function<PathAnswer(const World&,
                                                const OptimizeRequest&)>& ask) {
  const double rate = RateOf(flags);
  const MotionForm form = MotionFormOf(flags);
  const bool has_rate = form == MotionForm::kCsv || IsRos(form);
  if (IsRos(form) || form == MotionForm::kGcode) {
    RequireUnit(scene.workspace.unit, "--output " + flags.output);
  }
  OutputFiles outputs;
  const std::string target =
      flags.json ? AnswerTarget(flags.output) : flags.output;
  DeclareIfNamed(&outputs, target, "--output", kMotionEndings);
  DeclareIfNamed(&outputs, flags.html, "--html", {".html", ".htm"});
  if (!flags.html.empty()) RequireViewer();
  const World world(scene.workspace, scene.name, UserCache(flags.no_cache),
                    flags.world);
  OptimizeRequest request = OptimizeRequestOf(scene);
  // Also where it is what it would be without the flag.
  if (flags.has_margin) request.margin = scene.trajectory.margin;
  request.requires_margin = flags.require;
  request.verifies = flags.verify;
  if (flags.routes) request.options.routes = *flags.routes;
  if (!flags.time_limit.empty()) {
    request.options.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  request.Validate(world);
  if (has_rate) RequireFewRows(LeastDuration(request), rate);
  TellAbout(scene);
  const std::string beyond = MarginBeyondReach(world, request);
  if (!beyond.empty()) Warn(beyond);
  Progress("a motion in time");
  // Asked for the first time when there is a curve.
  std::optional<internal::InterruptAsks> ctrl_c;
  request.is_interrupted = [&ctrl_c] {
    if (!ctrl_c) {
      ctrl_c.emplace();
      Progress("looking for a faster curve; Ctrl-C takes the best so far");
    }
    return ctrl_c->HasAsked();
  };
  const PathAnswer answer = ask(world, request);
  ctrl_c.reset();
  const WorldSpaces* const built = world.Built(SpaceLayout::kSealed);
  TellAboutSpaces(world, built == nullptr ? 0 : built->triangles);
  if (!target.empty()) {
    const TimedJson row = MotionRow(scene, world, request, answer);
    outputs.Write(target, MotionText(form, world, answer, row, rate));
  }
  if (!flags.html.empty()) {
    View view = SceneView(scene);
    view.paths = {PathInTime(request, answer)};
    outputs.Write(flags.html, ViewPage(view));
  }
  CommitAndTell(&outputs, TimedSentence(scene, answer));
  if (answer.status == PathStatus::kVerificationFailed) {
    FailVerification(scene.name + ": " + answer.reason);
  }
  return answer.is_solved ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
