// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/timed_answer.h"

#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "files/interruption.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/motion_form.h"
#include "problems/output/answer_row.h"
#include "problems/output/json_text.h"
#include "problems/output/motion_file.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_requests.h"
#include "viewer/motion_view.h"
#include "viewer/scene_view.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

using TimedJson = nlohmann::ordered_json;

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

std::string SlownessNote(const std::string& unit,
                         const OptimizeRequest& request,
                         const PathAnswer& answer) {
  constexpr double kSlow = 600.0;  // seconds; of Python, too (_sizes.py)
  const double seconds = answer.motion.duration();
  if (answer.motion.empty() || !(seconds > kSlow) || request.duration > 0.0) {
    return "";
  }
  return "the motion takes " + Rounded(seconds) +
         " s; are the limits in the scene's unit" +
         (unit.empty() ? "" : ", " + unit) + "?";
}

int AnswerInTime(const Scene& scene, const TimedFlags& flags,
                 const std::function<PathAnswer(const World&,
                                                const OptimizeRequest&)>& ask) {
  const double rate = RateOf(flags);
  const MotionForm form = MotionFormOf(flags);
  if (!scene.moving.empty()) {
    RequireClock(form, flags.output, "obstacles that move");
  }
  if (IsRos(form) || form == MotionForm::kGcode) {
    RequireUnit(scene.workspace.unit, "--output " + flags.output);
  }
  OutputFiles outputs;
  const std::string target =
      flags.json ? AnswerTarget(flags.output) : flags.output;
  DeclareIfNamed(&outputs, target, "--output", MotionEndings());
  DeclareIfNamed(&outputs, flags.html, "--html", {".html", ".htm"});
  if (!flags.html.empty()) RequireViewer();
  const World world(scene.workspace, scene.name, UserCache(flags.no_cache),
                    flags.world);
  OptimizeRequest request = OptimizeRequestOf(scene);
  ApplyTimedFlags(flags, scene, &request);
  request.Validate(world);
  if (HasRate(form)) RequireFewRows(LeastDuration(request), rate);
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
  const std::string slow = SlownessNote(scene.workspace.unit, request, answer);
  if (!slow.empty()) Warn(slow);
  if (!target.empty()) {
    const TimedJson row = MotionRow(scene, world, request, answer);
    outputs.Write(target, MotionText(form, world, answer, row, rate));
  }
  if (!flags.html.empty()) {
    View view = SceneView(scene);
    view.paths = {PathInTime(world, request, answer)};
    view.serve_command = flags.serve_command;
    view.movers = MoversOf(request.moving, answer.motion.duration());
    outputs.Write(flags.html, ViewPage(view));
  }
  CommitAndTell(&outputs, TimedSentence(scene, answer));
  if (answer.status == PathStatus::kVerificationFailed) {
    FailVerification(scene.name + ": " + answer.reason);
  }
  return answer.is_solved ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
