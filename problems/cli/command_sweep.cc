// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "core/mesh/counted.h"
#include "core/pi.h"
#include "core/solid/solid.h"
#include "problems/cli/command.h"
#include "problems/cli/flags.h"
#include "problems/cli/operands.h"
#include "problems/meshes/any_mesh.h"
#include "problems/output/json_text.h"
#include "problems/output/output_files.h"
#include "problems/output/text.h"

namespace phongpd::cli {
namespace {

using Eigen::Vector3d;

struct SweepFlags {
  std::string a;
  std::vector<std::string> b;
  std::string from = "0,0,0";
  std::string to;
  bool first = false;
  bool exact = false;
  bool clearance = false;
  bool json = false;
};

// R = R_z(yaw) R_y(pitch) R_x(roll), degrees.
Eigen::Quaterniond TurnByDegrees(double roll, double pitch, double yaw) {
  const auto about = [](double degrees, const Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * kPi / 180.0, axis);
  };
  const Eigen::Quaterniond turn = about(yaw, Vector3d::UnitZ()) *
                                  about(pitch, Vector3d::UnitY()) *
                                  about(roll, Vector3d::UnitX());
  return turn.normalized();
}

// 90, 90deg, 1.5rad: in degrees.
double Degrees(const std::string& text, const std::string& flag) {
  const auto is_letter = [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z');
  };
  const std::size_t letters = static_cast<std::size_t>(
      std::find_if_not(text.rbegin(), text.rend(), is_letter) - text.rbegin());
  const std::string number = text.substr(0, text.size() - letters);
  const std::string unit = text.substr(number.size());
  // "inf" is no unit either; ParseDouble says what it is.
  if (unit.empty() || number.empty()) return ParseDouble(text, flag);
  if (unit != "deg" && unit != "rad") {
    throw InputError(flag +
                     ": expected an angle as 90, 90deg or 1.5rad, found '" +
                     text + "'");
  }
  const double angle = ParseDouble(number, flag);
  return unit == "deg" ? angle : angle * 180.0 / kPi;
}

// Three numbers, six or seven; what is no unit quaternion RigidMotion refuses.
RobotPose PoseFlag(const std::string& text, const std::string& flag) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  std::vector<double> x;
  for (const std::string& word : words) {
    const bool is_angle = words.size() == 6 && x.size() >= 3;
    x.push_back(is_angle ? Degrees(word, flag) : ParseDouble(word, flag));
  }
  if (x.size() != 3 && x.size() != 6 && x.size() != 7) {
    throw InputError(
        flag +
        ": expected X,Y,Z, or with ROLL,PITCH,YAW in degrees (or 1.5rad), "
        "or with QW,QX,QY,QZ, found " +
        Counted(x.size(), "number") +
        (x.size() == 1 ? "; commas, no spaces, join them" : ""));
  }
  RobotPose pose;
  pose.position = {x[0], x[1], x[2]};
  if (x.size() == 6) pose.orientation = TurnByDegrees(x[3], x[4], x[5]);
  if (x.size() == 7) pose.orientation = {x[3], x[4], x[5], x[6]};
  CheckPose(pose, flag);
  return pose;
}

// As a solid where it is one, with vertices joined if that closes it; else its
// triangles, which is said.
TriangleMesh SweptMesh(const std::string& path) {
  const TriangleMesh mesh = LoadMesh(path);
  try {
    return MakeSolid(mesh, path);
  } catch (const InputError&) {
    Note(path + ": no solid, as phongpd check says; its triangles are judged");
    return mesh;
  }
}

std::vector<double> Cells(const RobotPose& pose) {
  const Eigen::Quaterniond& turn = pose.orientation;
  return {pose.position.x(), pose.position.y(), pose.position.z(), turn.w(),
          turn.x(),          turn.y(),          turn.z()};
}

// As a check: at `to`, and the part of the way of which nothing else is known.
RigidCheck FirstOf(const RigidFirstHit& hit) {
  RigidCheck check;
  check.outcome = hit.outcome;
  check.from = hit.from;
  check.to = hit.to;
  check.time = hit.outcome == MotionVerdict::kCollides
                   ? hit.to
                   : hit.from + 0.5 * (hit.to - hit.from);
  check.robot_mesh = hit.robot_mesh;
  check.robot_triangle = hit.robot_triangle;
  check.obstacle_mesh = hit.obstacle_mesh;
  check.obstacle_triangle = hit.obstacle_triangle;
  check.tests = hit.tests;
  return check;
}

// What is found of a motion, or, where that is undecided and --exact asks, of
// the one whose quaternion is linear.
struct SweepAnswer {
  RigidCheck check;
  bool is_exact = false;
  RobotPose pose;  // at the time told
  std::optional<RigidClearance> clearance;
};

SweepAnswer AnswerOf(const SweepFlags& flags, const RigidJudge& judge,
                     const RigidMotion& motion) {
  SweepAnswer answer;
  RigidCheck& check = answer.check;
  check = flags.first ? FirstOf(judge.FirstHit(motion)) : judge.Check(motion);
  answer.is_exact = flags.exact && check.outcome == MotionVerdict::kUndecided;
  if (!answer.is_exact) {
    answer.pose = motion.At(check.time);
    if (flags.clearance) answer.clearance = judge.Clearance(motion);
    return answer;
  }
  const QuaternionMotion linear =
      QuaternionMotion::Between(motion.start(), motion.end());
  check = judge.CheckExactly(linear);
  answer.pose = linear.At(check.time);
  if (flags.clearance) answer.clearance = judge.Clearance(linear);
  return answer;
}

std::string SweepJson(const SweepFlags& flags, const RigidMotion& motion,
                      const SweepAnswer& answer) {
  const RigidCheck& check = answer.check;
  nlohmann::ordered_json row = {{"status", ToString(check.outcome)},
                                {"start", Cells(motion.start())},
                                {"end", Cells(motion.end())},
                                {"turn", motion.angle() * 180.0 / kPi}};
  if (!check.IsFree()) {
    row["time"] = check.time;
    row["pose"] = Cells(answer.pose);
    row["from"] = check.from;
    row["to"] = check.to;
    if (check.robot_triangle >= 0) {
      row["robot_triangle"] = check.robot_triangle;
      row["obstacle"] = flags.b[static_cast<std::size_t>(check.obstacle_mesh)];
      row["obstacle_triangle"] = check.obstacle_triangle;
    }
  }
  if (flags.exact) row["exact"] = answer.is_exact;
  if (answer.clearance) {
    row["clearance"] = {{"lower", answer.clearance->lower},
                        {"upper", answer.clearance->upper},
                        {"time", answer.clearance->time}};
  }
  row["tests"] = check.tests;
  return JsonText(row) + '\n';
}

std::string SweepWords(const SweepFlags& flags, const RigidMotion& motion,
                       const SweepAnswer& answer) {
  const RigidCheck& check = answer.check;
  TextStream text;
  text << ToString(check.outcome);
  if (answer.is_exact) text << ", exactly, with its quaternion linear in time";
  if (check.IsFree()) {
    text << ": for the whole motion, proved; it turns by "
         << Rounded(motion.angle() * 180.0 / kPi, 6) << " degrees\n";
    if (answer.clearance) {
      text << "clearance: at least " << FormatDouble(answer.clearance->lower)
           << ", at most " << FormatDouble(answer.clearance->upper) << " at "
           << FormatDouble(answer.clearance->time) << " of the way\n";
    }
    return text.str();
  }
  const bool collides = check.outcome == MotionVerdict::kCollides;
  if (collides) {
    text << " at " << FormatDouble(check.time) << " of the way";
    if (flags.first) {
      text << ", free before " << FormatDouble(check.from);
    }
  } else {
    text << " from " << FormatDouble(check.from) << " to "
         << FormatDouble(check.to) << " of the way";
  }
  if (check.robot_triangle >= 0) {
    text << ": triangle " << check.robot_triangle << " of " << flags.a
         << (collides ? " meets" : " is not told apart from") << " triangle "
         << check.obstacle_triangle << " of "
         << flags.b[static_cast<std::size_t>(check.obstacle_mesh)] << '\n';
  } else {
    text << (collides ? ": one holds a part of the other\n"
                      : ": the search was too long\n");
  }
  return text.str();
}

int Sweep(const SweepFlags& flags) {
  const RigidMotion motion(PoseFlag(flags.from, "--from"),
                           PoseFlag(flags.to, "--to"));
  const TriangleMesh robot = SweptMesh(flags.a);
  std::vector<TriangleMesh> obstacles;
  for (const std::string& path : flags.b) {
    obstacles.push_back(SweptMesh(path));
    WarnOfUnits(robot, flags.a, obstacles.back(), path);
  }
  const RigidJudge judge({robot}, obstacles);
  const SweepAnswer answer = AnswerOf(flags, judge, motion);
  OutputFiles outputs;
  CommitAndTell(&outputs, flags.json ? SweepJson(flags, motion, answer)
                                     : SweepWords(flags, motion, answer));
  return answer.check.IsFree() ? kDone : kNoAnswer;
}

}  // namespace

Command AddSweep(CLI::App* app) {
  auto flags = std::make_shared<SweepFlags>();
  app->add_option("A", flags->a,
                  std::string("Mesh that moves and turns about its origin (") +
                      kMeshFormats + ")")
      ->required()
      ->type_name("FILE");
  app->add_option("B", flags->b, "Meshes that stay")
      ->required()
      ->type_name("FILE");
  app->add_option(
         "--from", flags->from,
         "First pose of A: its position, X,Y,Z; turned about x, then "
         "y, then z, X,Y,Z,ROLL,PITCH,YAW in degrees (or 1.5rad); or by a unit "
         "quaternion, X,Y,Z,QW,QX,QY,QZ")
      ->capture_default_str()
      ->type_name("POSE");
  app->add_option("--to", flags->to,
                  "Last pose; between them A goes straight and turns about one "
                  "axis, the shorter way")
      ->required()
      ->type_name("POSE");
  CLI::Option* first =
      app->add_flag("--first", flags->first,
                    "Where it collides, when first: the time to 1e-9 of the "
                    "way, or as near as rounding allows, free before, proved");
  app->add_flag("--exact", flags->exact,
                "What stays undecided is decided in rational numbers, and what "
                "touches collides; of the motion whose quaternion is linear in "
                "time, which turns faster in the middle")
      ->excludes(first);
  app->add_flag("--clearance", flags->clearance,
                "How close A comes to B on the way: at least and at most, to a "
                "thousandth, proved");
  AddJson(app, &flags->json,
          "An object: status, poses, and where it is not free the time and "
          "the triangles");
  AddExamples(
      app,
      {"phongpd sweep robot.off obstacle.stl --to 1,0,0",
       "phongpd sweep robot.off a.stl b.stl --from 0,0,2 --to 1,0,2,0,0,90",
       "phongpd sweep robot.off obstacle.stl --to 1,0,0 --first",
       "phongpd sweep robot.off obstacle.stl --to 1,0,0 --clearance --exact",
       "phongpd sweep robot.off obstacle.stl --from -1,0,0 --to "
       "0,0,0,0,0,0,1 --json"},
      "Exit code 0: free for the whole motion, proved, rounding included; 1: "
      "it collides, or comes too close to be decided. Meshes that are no "
      "solids are judged by their triangles.");
  return [flags] { return Sweep(*flags); };
}

}  // namespace phongpd::cli
