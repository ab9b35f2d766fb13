// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/timed_answer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/files/interruption.h"
#include "core/mesh/mesh_error.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/studies/answer_check.h"
#include "problems/studies/clearance_wish.h"
#include "problems/studies/motion_file.h"

namespace phongpd::cli {
namespace {

using TimedJson = nlohmann::ordered_json;

constexpr double kDefaultRate = 100.0;  // Hz
constexpr double kMostRate = 1e6;

// By the name of the output.
enum class MotionForm { kJson, kCsv, kRos, kGcode };

const std::vector<std::string> kMotionEndings = {".json", ".jsonl", ".csv",
                                                 ".yaml", ".gcode", ".nc"};

MotionForm MotionFormOf(const TimedFlags& flags) {
  if (FormOf(flags.output, flags.json) == AnswerForm::kCsv) {
    return MotionForm::kCsv;
  }
  const std::string ending = EndingOf(flags.output);
  const MotionForm form = ending == ".yaml" ? MotionForm::kRos
                          : ending == ".gcode" || ending == ".nc"
                              ? MotionForm::kGcode
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
  if (form != MotionForm::kCsv && form != MotionForm::kRos) {
    throw InputError(
        "--rate: expected --output FILE.csv or FILE.yaml, which it is the rate "
        "of, found " +
        (flags.output.empty() ? "none" : flags.output));
  }
  return rate;
}

// Which no motion over `way` is shorter than: per axis at its velocity v all
// the time; from rest to rest half of it at acceleration a, half at −a, or at
// jerk j, −j, j by 1 : 2 : 1.
double LeastDuration(const Eigen::Vector3d& way, const CurveOptions& options) {
  const MotionLimits& limits = options.limits;
  const bool has_rests = options.start.IsAtRest() && options.end.IsAtRest();
  double least = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::abs(way[k]);
    least = std::max(least, d / limits.velocity[k]);
    if (!has_rests) continue;
    least = std::max({least, 2.0 * std::sqrt(d / limits.acceleration[k]),
                      std::cbrt(32.0 * d / limits.jerk[k])});
  }
  return least;
}

// Throws InputError where TimedCsv would, once the motion is known, have too
// many rows however fast that is.
void RequireFewRows(const Scene& scene, const CurveOptions& options,
                    double rate) {
  const double least = LeastDuration(scene.goal - scene.start, options);
  if (least * rate <= kMostTimedRows) return;
  throw InputError("--rate: expected at most " + FormatDouble(kMostTimedRows) +
                   " rows for a motion that takes " + Rounded(least) +
                   " s at least, found " + FormatDouble(rate) + " Hz");
}

std::string Percent(double share) { return Rounded(100.0 * share) + " %"; }

std::string MotionText(MotionForm form, const World& world, const Scene& scene,
                       const TimedTrajectory& timed, const TimedJson& row,
                       double rate) {
  // A machine reads no status: it gets answers only.
  const Trajectory trajectory =
      row.at("solved").get<bool>() ? timed.curve.trajectory : Trajectory();
  switch (form) {
    case MotionForm::kCsv:
      return TimedCsv(trajectory, rate);
    case MotionForm::kRos:
      return RosTrajectory(trajectory, rate, scene.unit);
    case MotionForm::kGcode:
      return MotionGcode(*world.Convolution().free_space, trajectory,
                         scene.unit);
    case MotionForm::kJson:
      break;
  }
  return JsonText(row) + '\n';
}

// For people.
std::string TimedSentence(const TimedTrajectory& timed, const TimedJson& row) {
  const std::string name = row.at("scene").get<std::string>() + ": ";
  const std::string reason = row.at("reason").get<std::string>();
  const std::string more = reason.empty() ? "\n" : "; " + reason + "\n";
  const TimedJson& unit = row.at("lengths").at("unit");
  if (timed.curve.trajectory.empty()) {
    return name + "no trajectory, " + row.at("status").get<std::string>() +
           more;
  }
  return name + Rounded(timed.curve.duration, 6) + " s, " +
         (row.at("certified").get<bool>() ? "certified" : "not certified") +
         ", " + row.at("status").get<std::string>() + ", clearance " +
         Rounded(timed.curve.clearance) +
         (unit.is_null() ? "unit" : unit.get<std::string>()) +
         " at least; of the limits " + Percent(timed.use.velocity) +
         " of velocity, " + Percent(timed.use.acceleration) +
         " of acceleration, " + Percent(timed.use.jerk) + " of jerk" + more;
}

}  // namespace

void AddMotion(CLI::App* app, const std::string& without_limits,
               const std::string& without_task, MotionWords* words) {
  app->add_option("--limits", words->limits,
                  "V,A,J: of velocity, acceleration and jerk, in the scene's "
                  "unit and seconds, each one number or x/y/z (" +
                      without_limits + ")")
      ->type_name("V,A,J");
  app->add_option(
         "--via", words->via,
         "A place to pass on the way, again for the next one: LENGTH is "
         "how close to come, more than 0 and at most D (0.001D if not "
         "set; 0.01D is a share of D, 0.5unit in the scene's unit), "
         "DWELL seconds to rest there, at the place itself (" +
             without_task + ")")
      ->type_name("X,Y,Z[,LENGTH[,DWELL]]")
      ->allow_extra_args(false);
  app->add_option(
         "--duration", words->duration,
         "Seconds that the motion takes, with as little jerk as can be "
         "found; 0: as few as can be (" +
             without_task + ")")
      ->type_name("S");
  app->add_option("--rate", words->rate,
                  "Rows a second of an --output FILE.csv or FILE.yaml, more "
                  "than 0 and at most 1e6 (100 if not set)")
      ->type_name("HZ");
}

std::optional<MotionLimits> LimitsOf(const MotionWords& words,
                                     const Scene& scene) {
  if (words.limits == "none") return std::nullopt;
  if (words.limits.empty()) return scene.limits;
  return ParseLimits(words.limits, "--limits");
}

void RequireNoMotion(const MotionWords& words) {
  for (const auto& [flag, is_given] :
       {std::pair("--rate", !words.rate.empty()),
        std::pair("--via", !words.via.empty()),
        std::pair("--duration", !words.duration.empty())}) {
    if (!is_given) continue;
    throw InputError(std::string(flag) +
                     ": expected --limits with it, found none");
  }
}

void SetTask(const MotionWords& words, Scene* scene) {
  if (!words.duration.empty()) {
    scene->duration = ParseDouble(words.duration, "--duration");
  }
  if (words.via.empty()) return;
  scene->via.clear();
  const double diagonal = ContactBounds(scene->workspace).Diagonal();
  for (const std::string& text : words.via) {
    scene->via.push_back(ParseVia(text, "--via", diagonal, scene->unit));
  }
}

int AnswerInTime(
    const Scene& scene, const MotionLimits& limits, const TimedFlags& flags,
    const std::function<TimedTrajectory(const World&, const CurveOptions&)>&
        ask) {
  const double rate = RateOf(flags);
  const MotionForm form = MotionFormOf(flags);
  const bool has_rate = form == MotionForm::kCsv || form == MotionForm::kRos;
  if (form == MotionForm::kRos || form == MotionForm::kGcode) {
    RequireUnit(scene.unit, "--output " + flags.output);
  }
  OutputFiles outputs;
  const std::string target =
      flags.json ? AnswerTarget(flags.output) : flags.output;
  DeclareIfNamed(&outputs, target, "--output", kMotionEndings);
  const World world(scene.workspace, scene.name, UserCache(flags.no_cache),
                    flags.world);
  CurveOptions options = SceneCurveOptions(scene, world, limits);
  if (!flags.time_limit.empty()) {
    options.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  options.Validate();
  if (has_rate) RequireFewRows(scene, options, rate);
  TellAbout(scene);
  const ClearanceWish wish =
      WishOfTrajectory(scene, flags.has_margin, flags.require);
  const std::string beyond = BeyondTheEnds(world, scene, wish);
  if (!beyond.empty()) Warn(beyond);
  Progress("a motion in time");
  // Asked for the first time when there is a curve.
  std::optional<internal::InterruptAsks> ctrl_c;
  options.is_interrupted = [&ctrl_c] {
    if (!ctrl_c) {
      ctrl_c.emplace();
      Progress("looking for a faster curve; Ctrl-C takes the best so far");
    }
    return ctrl_c->HasAsked();
  };
  const TimedTrajectory timed = ask(world, options);
  ctrl_c.reset();
  TimedJson row = TimedRow(scene, world, options, timed);
  AnswerCheck check(flags.verify);
  check.Judge(scene, world, ClaimsOf(timed), &row);
  TellClearance(world, scene, wish, &row);
  const WorldSpaces* const built = world.Built(SpaceLayout::kSealed);
  TellAboutSpaces(world, built == nullptr ? 0 : built->triangles);
  if (!target.empty()) {
    outputs.Write(target, MotionText(form, world, scene, timed, row, rate));
  }
  CommitAndTell(&outputs, TimedSentence(timed, row));
  check.RequireNoFailure();
  return row.at("solved").get<bool>() ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
