// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/world/preset.h"

// What the page of `view --serve` asks, read with care: it is the only thing
// that comes to the program from outside.
namespace phongpd::cli {

enum class TaskKind {
  kTranslates,  // one robot
  kTurns,       // one that turns as it moves
  kRobots,      // several that translate
};

enum class QuestionKind { kPlan, kOptimize, kDepth };

const char* ToString(QuestionKind kind);  // "plan", "optimize", "depth"

// One question, of a scene of its kind:
//   what     "plan", "optimize" or "depth"; of several robots no "plan"
//   start    [x, y, z], where the robot begins, or how deep it is there; the
//            scene's unit; of several robots only of "depth"
//   goal     the same of its end; not of "depth"
//   start_turn, goal_turn
//            [w, x, y, z], of unit length, how a robot that turns is turned
//            there; none: not at all
//   robots   of "optimize" for several: {id, start, goal} of each that is not
//            where the scene has it
//   robot    of "depth" for several: the id of the one that is at start
//   options  planner of "plan" and metric of "optimize" for one robot that
//            translates; preset where it translates; seed: as the commands'
//            flags of these names; no others
struct SolveQuestion {
  struct Robot {
    std::size_t index = 0;  // in the scene
    Eigen::Vector3d start = Eigen::Vector3d::Zero();
    Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  };

  QuestionKind what = QuestionKind::kPlan;
  RobotPose start, goal;
  std::vector<Robot> robots;
  std::size_t robot = 0;  // of the depth for several
  nlohmann::ordered_json options;

  std::optional<std::uint64_t> Seed() const;
  std::optional<Preset> GivenPreset() const;
};

// What a question is asked about.
struct QuestionScope {
  TaskKind kind = TaskKind::kTranslates;
  // Around which positions make sense.
  BoundingBox room = ComputeBounds(TriangleMesh());
  std::vector<std::string> robots;  // of kRobots: their ids
};

// Throws InputError "question: /start: expected ..., found ...".
SolveQuestion ReadQuestion(const std::string& text, const QuestionScope& scope);
[[noreturn]] void RefuseQuestion(const std::string& where,
                                 const std::string& expected,
                                 const std::string& found);

// Of the `seconds` that an answer may take, those for its search, nine tenths:
// what was found, or that nothing was, is to come within them.
double SearchSeconds(double seconds);

// true once it is cancelled, or these have gone by from now.
std::function<bool()> EndOf(double seconds, std::function<bool()> is_cancelled);

}  // namespace phongpd::cli
