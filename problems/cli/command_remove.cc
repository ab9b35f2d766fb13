// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/mesh/counted.h"
#include "planners/solve/removal.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"
#include "viewer/rigid_view.h"
#include "viewer/view_page.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;
using Step = Disassembly::Step;

constexpr double kTurnSeconds = 10.0;

struct RemoveFlags {
  std::vector<std::string> parts;
  bool all = false;
  std::string tolerance = "0";
  std::string unit;
  bool turns = false;
  std::string time_limit;
  std::string output, html;
  std::string repair = "reject";
  bool json = false;
  bool verify = true;
};

std::vector<Solid> LoadParts(const RemoveFlags& flags) {
  std::vector<Solid> parts;
  for (const std::string& path : flags.parts) {
    parts.push_back(LoadSolid(path, ParseRepair(flags.repair, "--repair")));
    WarnOfUnits(parts.front(), flags.parts.front(), parts.back(), path);
  }
  return parts;
}

Disassembly Answer(const RemoveFlags& flags, const std::vector<Solid>& parts,
                   const RemovalOptions& options) {
  if (flags.all) return Disassemble(parts, options);
  Disassembly answer;
  Step step{0, RemovePart(parts[0], {parts.begin() + 1, parts.end()}, options)};
  answer.seconds = step.removal.seconds;
  (step.removal.IsOut() ? answer.steps : answer.stuck)
      .push_back(std::move(step));
  return answer;
}

// Of a way by translation, too: its pivot is the origin.
std::vector<RobotPose> PosesOf(const Removal& removal) {
  std::vector<RobotPose> poses = removal.poses;
  for (const Eigen::Vector3d& q : removal.path) {
    RobotPose pose;
    pose.position = q;
    poses.push_back(pose);
  }
  return poses;
}

std::string Csv(const RemoveFlags& flags, const Disassembly& answer) {
  TextStream text;
  text << "step,part,x,y,z"
       << (flags.turns ? ",qw,qx,qy,qz,pivot_x,pivot_y,pivot_z\n" : "\n");
  const auto write = [&text](std::initializer_list<double> cells) {
    for (const double cell : cells) text << ',' << FormatDouble(cell);
  };
  for (std::size_t i = 0; i < answer.steps.size(); ++i) {
    const Removal& removal = answer.steps[i].removal;
    const std::string part = CsvCell(flags.parts[answer.steps[i].part]);
    const Eigen::Vector3d& p = removal.pivot;
    for (const RobotPose& pose : PosesOf(removal)) {
      text << i + 1 << ',' << part;
      const Eigen::Vector3d& q = pose.position;
      write({q.x(), q.y(), q.z()});
      const Eigen::Quaterniond& r = pose.orientation;
      if (flags.turns) write({r.w(), r.x(), r.y(), r.z(), p.x(), p.y(), p.z()});
      text << '\n';
    }
  }
  return text.str();
}

Json ToJson(const RemoveFlags& flags, const Step& step) {
  const Removal& removal = step.removal;
  Json row = {{"part", flags.parts[step.part]},
              {"status", ToString(removal.status)},
              {"reason", removal.reason},
              {"needs_turns", removal.needs_turns},
              {"granted",
               {{"faces", removal.granted_least},
                {"vertices_at_most", removal.granted_most}}}};
  if (!removal.poses.empty()) {
    const Eigen::Vector3d& p = removal.pivot;
    row["path_length"] = removal.length;
    row["pivot"] = {p.x(), p.y(), p.z()};
    row["path"] = Json::array();
    for (const RobotPose& pose : removal.poses) {
      const Eigen::Vector3d& q = pose.position;
      const Eigen::Quaterniond& r = pose.orientation;
      row["path"].push_back({q.x(), q.y(), q.z(), r.w(), r.x(), r.y(), r.z()});
    }
  } else if (removal.IsOut()) {
    row["path_length"] = removal.length;
    row["clearance"] = removal.clearance;
    row["path"] = Json::array();
    for (const Eigen::Vector3d& q : removal.path) {
      row["path"].push_back({q.x(), q.y(), q.z()});
    }
  }
  row["seconds"] = removal.seconds;
  return row;
}

Json ToJson(const RemoveFlags& flags, const Disassembly& answer) {
  Json row = {{"status", answer.IsComplete() ? "out"
                         : answer.IsProved() ? "held"
                                             : "undecided"},
              {"steps", Json::array()},
              {"stuck", Json::array()},
              {"seconds", answer.seconds}};
  for (const Step& step : answer.steps) {
    row["steps"].push_back(ToJson(flags, step));
  }
  for (const Step& step : answer.stuck) {
    row["stuck"].push_back(ToJson(flags, step));
  }
  return row;
}

// The one that has no step.
std::string LastPart(const RemoveFlags& flags, const Disassembly& answer) {
  std::vector<std::string> left = flags.parts;
  for (const Step& step : answer.steps) {
    left.erase(std::find(left.begin(), left.end(), flags.parts[step.part]));
  }
  return left.front();
}

std::string Words(const RemoveFlags& flags, const Disassembly& answer) {
  TextStream text;
  int number = 0;
  for (const Step& step : answer.steps) {
    const Removal& removal = step.removal;
    if (flags.all) text << ++number << ". ";
    text << flags.parts[step.part] << ": out, ";
    if (removal.poses.empty()) {
      text << Counted(removal.path.size(), "point") << ", length "
           << Rounded(removal.length, 4) << ", clearance "
           << Rounded(removal.clearance);
    } else {
      text << "turning, which it has to: "
           << Counted(removal.poses.size(), "pose") << ", length "
           << Rounded(removal.length, 4);
    }
    if (removal.granted_least > 0.0) {
      text << ", drawn in by " << Rounded(removal.granted_least, 4)
           << " (vertices by at most " << Rounded(removal.granted_most, 4)
           << ')';
    }
    text << '\n';
  }
  if (flags.all && answer.IsComplete()) {
    text << LastPart(flags, answer) << ": stays, the last\n";
  }
  for (const Step& step : answer.stuck) {
    text << flags.parts[step.part] << ": "
         << (step.removal.status == PathStatus::kInfeasibleProved
                 ? "held: no translation takes it out, proved"
                 : step.removal.reason)
         << '\n';
  }
  return text.str();
}

View PageOf(const RemoveFlags& flags, const std::vector<Solid>& parts,
            const Disassembly& answer) {
  View view;
  view.title = "remove " + flags.parts.front();
  view.robot = parts.front();
  view.start = Eigen::Vector3d::Zero();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    view.meshes.push_back({flags.parts[i], ViewRole::kObstacle, parts[i]});
  }
  if (!flags.unit.empty()) view.unit = flags.unit;
  if (!answer.steps.empty() && !answer.steps.front().removal.poses.empty()) {
    const Removal& removal = answer.steps.front().removal;
    view.robot = Translated(view.robot, -removal.pivot);
    view.start = removal.pivot;
    view.goal = removal.poses.back().position;
    view.goal_turn = removal.poses.back().orientation;
    view.paths.push_back(RigidPath("way out", removal.poses, true));
  } else if (!answer.steps.empty()) {
    view.goal = answer.steps.front().removal.path.back();
    view.paths.push_back({"way out", answer.steps.front().removal.path});
  }
  return view;
}

int Remove(const RemoveFlags& flags) {
  if (flags.parts.size() < 2) {
    throw InputError(flags.parts.front() +
                     ": expected other parts that it is among, found none");
  }
  for (std::size_t i = 0; i < flags.parts.size(); ++i) {
    if (std::count(flags.parts.begin(), flags.parts.end(), flags.parts[i]) >
        1) {
      throw InputError(flags.parts[i] + ": expected each part once");
    }
  }
  if (flags.all && !flags.html.empty()) {
    throw InputError(
        "--html: expected of one part, found with --all; take the part that a "
        "page is of, and what is left, without --all");
  }
  RemovalOptions options;
  options.tolerance =
      MeshLengthFlag(flags.tolerance, "--tolerance", flags.unit);
  options.verifies = flags.verify;
  if (flags.turns) {
    options.turn_seconds = flags.time_limit.empty()
                               ? kTurnSeconds
                               : ParseDouble(flags.time_limit, "--time");
  } else if (!flags.time_limit.empty()) {
    throw InputError("--time: expected --turns with it, found none");
  }
  options.Validate();
  OutputFiles outputs;
  const AnswerForm form = FormOf(flags.output, flags.json);
  if (!flags.output.empty()) DeclareTable(&outputs, flags.output, "--output");
  DeclareIfNamed(&outputs, flags.html, "--html", {".html", ".htm"});
  if (flags.json && flags.output.empty()) RequireFreeStandardOutput(outputs);
  const std::vector<Solid> parts = LoadParts(flags);
  const Disassembly answer = Answer(flags, parts, options);
  const std::string words = Words(flags, answer);
  const std::string rows = form == AnswerForm::kCsv
                               ? Csv(flags, answer)
                               : JsonText(ToJson(flags, answer), 2) + '\n';
  if (!flags.html.empty()) {
    outputs.Write(flags.html, ViewPage(PageOf(flags, parts, answer)));
  }
  if (!flags.output.empty()) outputs.Write(flags.output, rows);
  CommitAndTell(&outputs, flags.json && flags.output.empty() ? rows : words);
  for (const Step& step : answer.stuck) {
    if (step.removal.status == PathStatus::kVerificationFailed ||
        step.removal.status == PathStatus::kNotCertified) {
      FailVerification(flags.parts[step.part] + ": " + step.removal.reason);
    }
  }
  return answer.IsComplete() ? kDone : kNoAnswer;
}

}  // namespace

Command AddRemove(CLI::App* app) {
  auto flags = std::make_shared<RemoveFlags>();
  app->add_option("PART", flags->parts,
                  std::string("The part that is to come out, and then all that "
                              "stay; as they lie in the assembly (") +
                      kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  app->add_flag("--all", flags->all,
                "An order in which all of them come out, one after the other");
  app->add_option("--tolerance", flags->tolerance,
                  "How far the faces of a part that moves may be drawn in, in "
                  "the meshes' unit, where parts are drawn to fit exactly and "
                  "touch or overlap as they lie; what was granted is told")
      ->type_name("LENGTH")
      ->capture_default_str();
  AddMeshUnit(app, &flags->unit);
  app->add_flag(
      "--turns", flags->turns,
      "Where no translation takes it out, proved, look for a way on "
      "which it turns: certified, or not found, which proves nothing");
  app->add_option("--time", flags->time_limit,
                  "Of that, for a part, seconds (10 if not set)")
      ->transform(SecondsAboveZero())
      ->type_name("S");
  app->add_option("--output", flags->output,
                  "The ways: FILE.csv with the columns step, part, x, y, z of "
                  "the part's translation, with --turns a pose and its pivot, "
                  "else an object as --json")
      ->type_name("FILE");
  app->add_option("--html", flags->html,
                  "A page that plays the way of one part")
      ->type_name("FILE");
  AddRepair(app, &flags->repair);
  AddJson(app, &flags->json, "An object: status, steps, and what is stuck");
  AddVerify(app, &flags->verify);
  AddExamples(
      app,
      {"phongpd remove peg.off plate.off",
       "phongpd remove pin.stl housing.stl lid.stl --tolerance 0.01 --html "
       "out.html",
       "phongpd remove bayonet.stl socket.stl --turns --time 60 --unit mm "
       "--tolerance 0.01mm",
       "phongpd remove --all a.stl b.stl c.stl --tolerance 0.01 --json"},
      "By translation alone, unless --turns. Exit code 0: out, certified for "
      "the whole way; 1: not, and held where that is proved.");
  return [flags] { return Remove(*flags); };
}

}  // namespace phongpd::cli
