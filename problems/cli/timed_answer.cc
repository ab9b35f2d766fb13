// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/timed_answer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/output/json_text.h"
#include "problems/output/text.h"
#include "problems/studies/answer_check.h"
#include "problems/studies/clearance_wish.h"

namespace phongpd::cli {
namespace {

using TimedJson = nlohmann::ordered_json;

constexpr double kDefaultRate = 100.0;  // Hz
constexpr double kMostRate = 1e6;

double RateOf(const TimedFlags& flags) {
  if (flags.rate.empty()) return kDefaultRate;
  const double rate = ParseDouble(flags.rate, "--rate");
  if (!(rate > 0.0 && rate <= kMostRate)) {
    throw InputError("--rate: expected a number above 0 and at most " +
                     FormatDouble(kMostRate) + " (Hz), found " + flags.rate);
  }
  if (FormOf(flags.output, false) != AnswerForm::kCsv) {
    throw InputError(
        "--rate: expected --output FILE.csv, which it is the rate of, found " +
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

void AddTimed(CLI::App* app, const std::string& of_none, std::string* limits,
              std::string* rate) {
  app->add_option("--limits", *limits,
                  "V,A,J: of velocity, acceleration and jerk, in the scene's "
                  "unit and seconds, each one number or x/y/z (" +
                      of_none + ")")
      ->type_name("V,A,J");
  app->add_option("--rate", *rate,
                  "Rows a second of an --output FILE.csv, more than 0 and at "
                  "most 1e6 (100 if not set)")
      ->type_name("HZ");
}

std::optional<MotionLimits> LimitsOf(const std::string& flag,
                                     const Scene& scene) {
  if (flag == "none") return std::nullopt;
  if (flag.empty()) return scene.limits;
  return ParseLimits(flag, "--limits");
}

int AnswerInTime(
    const Scene& scene, const MotionLimits& limits, const TimedFlags& flags,
    const std::function<TimedTrajectory(const World&, const CurveOptions&)>&
        ask) {
  const double rate = RateOf(flags);
  const bool is_table = FormOf(flags.output, flags.json) == AnswerForm::kCsv;
  OutputFiles outputs;
  const std::string target =
      flags.json ? AnswerTarget(flags.output) : flags.output;
  DeclareIfNamed(&outputs, target, "--output", {".json", ".jsonl", ".csv"});
  const World world(scene.workspace, scene.name, UserCache(flags.no_cache),
                    flags.world);
  CurveOptions options = SceneCurveOptions(scene, world, limits);
  if (!flags.time_limit.empty()) {
    options.time_limit = ParseDouble(flags.time_limit, "--time");
  }
  options.Validate();
  if (is_table) RequireFewRows(scene, options, rate);
  TellAbout(scene);
  const ClearanceWish wish =
      WishOfTrajectory(scene, flags.has_margin, flags.require);
  const std::string beyond = BeyondTheEnds(world, scene, wish);
  if (!beyond.empty()) Warn(beyond);
  Progress("a motion in time");
  const TimedTrajectory timed = ask(world, options);
  TimedJson row = TimedRow(scene, world, options, timed);
  AnswerCheck check(flags.verify);
  check.Judge(scene, world, ClaimsOf(timed), &row);
  TellClearance(world, scene, wish, &row);
  const WorldSpaces* const built = world.Built(SpaceLayout::kSealed);
  TellAboutSpaces(world, built == nullptr ? 0 : built->triangles);
  if (!target.empty()) {
    outputs.Write(target, is_table ? TimedCsv(timed.curve.trajectory, rate)
                                   : JsonText(row) + '\n');
  }
  CommitAndTell(&outputs, TimedSentence(timed, row));
  check.RequireNoFailure();
  return row.at("solved").get<bool>() ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
