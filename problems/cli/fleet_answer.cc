// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/fleet_answer.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/mesh/mesh_error.h"
#include "files/interruption.h"
#include "problems/cli/command.h"
#include "problems/cli/explanation.h"
#include "problems/cli/flags.h"
#include "problems/cli/motion_form.h"
#include "problems/output/fleet_row.h"
#include "problems/output/json_text.h"
#include "problems/output/motion_file.h"
#include "problems/output/text.h"
#include "viewer/motion_view.h"
#include "viewer/scene_view.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

// "run.csv" of "left" is "run.left.csv", "run.multidof.yaml" is
// "run.left.multidof.yaml".
std::string FileOf(const std::string& output, const std::string& robot,
                   MotionForm form) {
  std::filesystem::path path(output);
  std::string ending = path.extension().string();
  path.replace_extension();
  if (form == MotionForm::kRosMultiDof) {
    ending = path.extension().string() + ending;
    path.replace_extension();
  }
  return path.string() + "." + robot + ending;
}

// Of one robot, in a form of its own.
std::string FileText(MotionForm form, const FleetRobot& robot,
                     const Trajectory& motion, double rate) {
  const std::string& unit = robot.world.workspace().unit;
  return form == MotionForm::kCsv ? TimedCsv(motion, rate)
         : form == MotionForm::kRos
             ? RosTrajectory(motion, rate, unit, robot.name)
             : RosMultiDofTrajectory(motion, rate, unit, robot.name);
}

// Where each robot, or all of them, are written to; empty: nowhere.
std::vector<std::string> Targets(const FleetScene& scene,
                                 const TimedFlags& flags, MotionForm form) {
  if (form == MotionForm::kJson) {
    return {flags.json ? AnswerTarget(flags.output) : flags.output};
  }
  std::vector<std::string> targets;
  for (const Scene& robot : scene.robots) {
    targets.push_back(FileOf(flags.output, robot.workspace.robot.name(), form));
  }
  return targets;
}

void WriteMotions(const std::vector<std::string>& targets,
                  const FleetScene& scene,
                  const std::vector<FleetRobot>& robots,
                  const FleetAnswer& answer, MotionForm form, double rate,
                  OutputFiles* outputs) {
  if (form == MotionForm::kJson) {
    if (targets.front().empty()) return;
    outputs->Write(targets.front(),
                   JsonText(FleetRow(scene, robots, answer)) + '\n');
    return;
  }
  for (std::size_t i = 0; i < robots.size(); ++i) {
    // A machine reads no status: it gets answers only.
    const Trajectory motion =
        answer.IsSolved() ? answer.robots[i].motion : Trajectory();
    outputs->Write(targets[i], FileText(form, robots[i], motion, rate));
  }
}

std::string Judged(bool is_free, const std::optional<Verification>& again) {
  return (is_free ? std::string("certified") : "not certified") +
         (again ? std::string(", ") + ToString(again->verdict) : "");
}

// For people: what holds for all, a line for each robot and one for each pair.
std::string FleetText(const FleetScene& scene,
                      const std::vector<FleetRobot>& robots,
                      const FleetAnswer& answer) {
  const std::string& own = scene.robots.front().workspace.unit;
  const std::string unit = own.empty() ? "unit" : own;
  if (!answer.IsSolved()) {
    return scene.name + ": no trajectories, " + ToString(answer.status) + "; " +
           answer.reason + "\n";
  }
  std::string text = scene.name + ": " + std::to_string(robots.size()) +
                     " robots, " + Rounded(answer.duration, 6) +
                     " s until all have arrived, certified pair by pair\n";
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const PathAnswer& one = answer.robots[i];
    text += "  " + robots[i].name + ": " + Rounded(one.motion.duration(), 6) +
            " s, clearance " + Rounded(one.clearance) + unit + " at least, " +
            Judged(one.is_free, one.evidence.verification) +
            (one.reason.empty() ? "" : "; " + one.reason) + "\n";
  }
  for (const FleetPair& pair : answer.pairs) {
    text += "  " + pair.first + " and " + pair.second + ": " +
            Rounded(pair.clearance) + unit +
            " at least, closest at t = " + Rounded(pair.time, 4) + " s, " +
            Judged(pair.is_free, pair.verification) + "\n";
  }
  return text;
}

void TellAboutRobots(const FleetScene& scene,
                     const std::vector<FleetRobot>& robots) {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (i == 0) {
      TellAbout(scene.robots[i]);
    } else {
      for (const std::string& line : scene.robots[i].warnings) Warn(line);
    }
    const std::string beyond =
        MarginBeyondReach(robots[i].world, robots[i].request);
    if (!beyond.empty()) Warn(robots[i].name + ": " + beyond);
  }
}

}  // namespace

int AnswerFleet(FleetScene scene, const TimedFlags& flags,
                const CLI::App* explains) {
  const double rate = RateOf(flags);
  const MotionForm form = MotionFormOf(flags);
  RequireClock(form, flags.output, "several robots");
  if (IsRos(form)) {
    RequireUnit(scene.robots.front().workspace.unit,
                "--output " + flags.output);
  }
  OutputFiles outputs;
  const std::vector<std::string> targets = Targets(scene, flags, form);
  for (const std::string& target : targets) {
    DeclareIfNamed(&outputs, target, "--output", MotionEndings());
  }
  DeclareIfNamed(&outputs, flags.html, "--html", {".html", ".htm"});
  if (!flags.html.empty()) RequireViewer();
  std::vector<FleetRobot> robots =
      RobotsOf(scene, UserCache(flags.no_cache), flags.world);
  // Asked for the first time when there is a curve.
  std::optional<internal::InterruptAsks> ctrl_c;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    OptimizeRequest& request = robots[i].request;
    ApplyTimedFlags(flags, scene.robots[i], &request);
    request.is_interrupted = [&ctrl_c] {
      if (!ctrl_c) {
        ctrl_c.emplace();
        Progress("looking for faster curves; Ctrl-C takes the best so far");
      }
      return ctrl_c->HasAsked();
    };
  }
  RequireFleet(robots);
  if (HasRate(form)) {
    for (const FleetRobot& robot : robots) {
      RequireFewRows(LeastDuration(robot.request), rate);
    }
  }
  TellAboutRobots(scene, robots);
  Progress("motions in time of " + std::to_string(robots.size()) + " robots");
  const FleetAnswer answer = OptimizeFleet(robots);
  ctrl_c.reset();
  if (explains != nullptr) {
    TellExplanation(ExplainFleet(*explains, robots, answer));
  }
  WriteMotions(targets, scene, robots, answer, form, rate, &outputs);
  if (!flags.html.empty()) {
    View view = FleetSceneView(scene);
    view.serve_command = flags.serve_command;
    AddFleet(robots, answer, &view);
    outputs.Write(flags.html, ViewPage(view));
  }
  for (std::size_t i = 0; i < answer.robots.size(); ++i) {
    const FleetRobot& robot = robots[i];
    const std::string slow = SlownessNote(robot.world.workspace().unit,
                                          robot.request, answer.robots[i]);
    if (!slow.empty()) Warn(robot.name + ": " + slow);
  }
  CommitAndTell(&outputs, FleetText(scene, robots, answer));
  if (answer.status == PathStatus::kVerificationFailed) {
    FailVerification(scene.name + ": " + answer.reason);
  }
  return answer.IsSolved() ? kDone : kNoAnswer;
}

}  // namespace phongpd::cli
