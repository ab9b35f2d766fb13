// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/solve_question.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <set>
#include <utility>

#include "planners/world/penetration_spec.h"
#include "planners/world/planner_id.h"
#include "problems/scenes/json_schema.h"

namespace phongpd::cli {
namespace {

using AskedJson = nlohmann::ordered_json;
using Eigen::Vector3d;

constexpr char kQuestion[] = "question";
// Beyond this many diagonals of the room there is nothing to find, and numbers
// lose their digits.
constexpr double kFarthest = 1e6;

AskedJson Numbers(int count) {
  return {{"type", "array"},
          {"items", {{"type", "number"}}},
          {"minItems", count},
          {"maxItems", count}};
}

constexpr QuestionKind kKinds[] = {QuestionKind::kPlan, QuestionKind::kOptimize,
                                   QuestionKind::kDepth};

AskedJson KindNames() {
  AskedJson names = AskedJson::array();
  for (const QuestionKind kind : kKinds) names.push_back(ToString(kind));
  return names;
}

// Of a name that the schema has let through.
QuestionKind KindOf(const AskedJson& name) {
  return *std::find_if(
      std::begin(kKinds), std::end(kKinds),
      [&name](QuestionKind kind) { return name == ToString(kind); });
}

AskedJson OptionsSchema() {
  return {{"type", "object"},
          {"additionalProperties", false},
          {"properties",
           {{"planner", {{"enum", PlannerNames()}}},
            {"metric", {{"enum", MetricNames()}}},
            {"preset", {{"enum", PresetNames()}}},
            {"seed",
             {{"type", "integer"}, {"minimum", 0}, {"maximum", 4294967295}}}}}};
}

AskedJson QuestionSchema(const QuestionScope& scope) {
  const AskedJson point = Numbers(3), turn = Numbers(4);
  AskedJson keys = {
      {"what", {{"enum", KindNames()}}}, {"start", point}, {"goal", point}};
  if (scope.kind == TaskKind::kTurns) {
    keys["start_turn"] = keys["goal_turn"] = turn;
  }
  if (scope.kind == TaskKind::kRobots) {
    keys["what"] = {{"enum", {"optimize", "depth"}}};
    const AskedJson id = {{"enum", scope.robots}};
    keys["robot"] = id;
    keys["robots"] = {
        {"type", "array"},
        {"maxItems", scope.robots.size()},
        {"items",
         {{"type", "object"},
          {"additionalProperties", false},
          {"required", {"id", "start", "goal"}},
          {"properties", {{"id", id}, {"start", point}, {"goal", point}}}}}};
  }
  keys["options"] = OptionsSchema();
  return {{"type", "object"},
          {"additionalProperties", false},
          {"required", {"what"}},
          {"properties", keys}};
}

// Which keys there must be, and which may be, beside what and options.
struct AskedKeys {
  std::set<std::string> needed, allowed;
};

AskedKeys KeysOf(TaskKind kind, bool is_depth) {
  if (kind == TaskKind::kRobots) {
    return is_depth ? AskedKeys{{"robot", "start"}, {}}
                    : AskedKeys{{"robots"}, {}};
  }
  AskedKeys keys{{"start"}, {}};
  if (!is_depth) keys.needed.insert("goal");
  if (kind != TaskKind::kTurns) return keys;
  keys.allowed.insert("start_turn");
  if (!is_depth) keys.allowed.insert("goal_turn");
  return keys;
}

void RequireKeys(const AskedJson& json, QuestionKind what, TaskKind kind) {
  const AskedKeys keys = KeysOf(kind, what == QuestionKind::kDepth);
  for (const std::string& key : keys.needed) {
    if (json.contains(key)) continue;
    RefuseQuestion("/" + key,
                   key == "robots"  ? "a list of robots"
                   : key == "robot" ? "the id of a robot"
                                    : "[x, y, z]",
                   "none");
  }
  for (const auto& [key, value] : json.items()) {
    if (key == "what" || key == "options" || keys.needed.count(key) > 0 ||
        keys.allowed.count(key) > 0) {
      continue;
    }
    RefuseQuestion("/" + key, std::string("none of ") + ToString(what),
                   Shortened(value));
  }
}

// Who is asked for it with that option?
bool TakesOption(const std::string& option, QuestionKind what, TaskKind kind) {
  if (what == QuestionKind::kDepth) return false;
  if (option == "planner") {
    return what == QuestionKind::kPlan && kind == TaskKind::kTranslates;
  }
  if (option == "metric") {
    return what == QuestionKind::kOptimize && kind == TaskKind::kTranslates;
  }
  return option == "seed" || kind != TaskKind::kTurns;
}

void RequireOptions(const SolveQuestion& question, TaskKind kind) {
  for (const auto& [key, value] : question.options.items()) {
    if (TakesOption(key, question.what, kind)) continue;
    RefuseQuestion("/options/" + key,
                   std::string("none of ") + ToString(question.what) +
                       (kind == TaskKind::kTurns    ? " of a robot that turns"
                        : kind == TaskKind::kRobots ? " of several robots"
                                                    : ""),
                   value.dump());
  }
}

Vector3d PointAt(const AskedJson& cells, const std::string& where,
                 const BoundingBox& room) {
  const Vector3d p(cells[0].get<double>(), cells[1].get<double>(),
                   cells[2].get<double>());
  if ((p - room.Center()).norm() > kFarthest * room.Diagonal()) {
    RefuseQuestion(where, "a position within a million D of the obstacles",
                   cells.dump());
  }
  return p;
}

RobotPose PoseAt(const AskedJson& json, const std::string& key,
                 const BoundingBox& room) {
  RobotPose pose;
  if (!json.contains(key)) return pose;
  pose.position = PointAt(json.at(key), "/" + key, room);
  const std::string turn = key + "_turn";
  if (!json.contains(turn)) return pose;
  const AskedJson& cells = json.at(turn);
  pose.orientation = {cells[0].get<double>(), cells[1].get<double>(),
                      cells[2].get<double>(), cells[3].get<double>()};
  CheckPose(pose, std::string(kQuestion) + ": /" + turn);
  return pose;
}

std::size_t IndexOf(const AskedJson& id, const QuestionScope& scope) {
  const auto found = std::find(scope.robots.begin(), scope.robots.end(),
                               id.get<std::string>());
  return static_cast<std::size_t>(found - scope.robots.begin());
}

std::vector<SolveQuestion::Robot> RobotsAt(const AskedJson& json,
                                           const QuestionScope& scope) {
  std::vector<SolveQuestion::Robot> robots;
  std::set<std::size_t> known;
  for (const AskedJson& one : json) {
    const std::string where = "/robots/" + std::to_string(robots.size());
    const std::size_t index = IndexOf(one.at("id"), scope);
    if (!known.insert(index).second) {
      RefuseQuestion(where + "/id", "each robot once",
                     one.at("id").dump() + " again");
    }
    robots.push_back({index,
                      PointAt(one.at("start"), where + "/start", scope.room),
                      PointAt(one.at("goal"), where + "/goal", scope.room)});
  }
  return robots;
}

}  // namespace

const char* ToString(QuestionKind kind) {
  switch (kind) {
    case QuestionKind::kPlan:
      return "plan";
    case QuestionKind::kOptimize:
      return "optimize";
    case QuestionKind::kDepth:
      return "depth";
  }
  return "";
}

std::optional<std::uint64_t> SolveQuestion::Seed() const {
  if (!options.contains("seed")) return std::nullopt;
  return options.at("seed").get<std::uint64_t>();
}

std::optional<Preset> SolveQuestion::GivenPreset() const {
  if (!options.contains("preset")) return std::nullopt;
  return ParsePreset(options.at("preset").get<std::string>(), "preset");
}

SolveQuestion ReadQuestion(const std::string& text,
                           const QuestionScope& scope) {
  const AskedJson json = ParseJson(text, kQuestion);
  RequireSchema(json, QuestionSchema(scope), kQuestion);
  SolveQuestion question;
  question.what = KindOf(json.at("what"));
  RequireKeys(json, question.what, scope.kind);
  question.options = json.value("options", AskedJson::object());
  RequireOptions(question, scope.kind);
  question.start = PoseAt(json, "start", scope.room);
  question.goal = PoseAt(json, "goal", scope.room);
  if (json.contains("robots")) {
    question.robots = RobotsAt(json.at("robots"), scope);
  }
  if (json.contains("robot")) question.robot = IndexOf(json["robot"], scope);
  return question;
}

void RefuseQuestion(const std::string& where, const std::string& expected,
                    const std::string& found) {
  JsonPlace{kQuestion, where}.Fail(expected, found);
}

double SearchSeconds(double seconds) { return 0.9 * seconds; }

std::function<bool()> EndOf(double seconds,
                            std::function<bool()> is_cancelled) {
  const auto end = std::chrono::steady_clock::now() +
                   std::chrono::duration<double>(SearchSeconds(seconds));
  return [end, asked = std::move(is_cancelled)] {
    return asked() || std::chrono::steady_clock::now() > end;
  };
}

}  // namespace phongpd::cli
