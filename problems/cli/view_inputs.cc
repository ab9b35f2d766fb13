// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/cli/view_inputs.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/contact/contact_space_file.h"
#include "core/mesh/counted.h"
#include "core/mesh/input_file.h"
#include "core/mesh/mesh_range.h"
#include "planners/world/planner_id.h"
#include "problems/cli/command.h"
#include "problems/cli/contact_space_file.h"
#include "problems/cli/operands.h"
#include "problems/cli/run_path.h"
#include "problems/cli/view_rows.h"
#include "problems/cli/view_tables.h"
#include "problems/cli/view_windows.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/operand_notes.h"
#include "problems/scenes/turning_families.h"
#include "problems/studies/motion.h"
#include "viewer/rigid_view.h"
#include "viewer/scene_view.h"

namespace phongpd::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t kMaxThingBytes = std::uintmax_t{1} << 30;
constexpr char kThings[] =
    "a mesh or contact space (OFF, OBJ, PLY, STL, DAE, glTF, GLB, 3MF, "
    "robot.urdf#link, .pcs), a scene (file or "
    "FAMILY:key=value,...), rows of optimize or plan (JSON Lines), a motion "
    "(CSV), or depths (CSV, JSON)";

[[noreturn]] void FailUnknown(const std::string& thing,
                              const std::string& found) {
  throw InputError(thing + ": expected " + kThings + ", found " + found);
}

std::string Extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return extension;
}

bool IsMesh(const std::string& path) {
  return NamesMesh(path) || NamesContactSpaceFile(path);
}

bool IsFamily(const std::string& thing) {
  const std::string name = thing.substr(0, thing.find(':'));
  const std::vector<std::string> families = SceneFamilyNames();
  return std::find(families.begin(), families.end(), name) != families.end();
}

// Collects things into a view.
class Collector {
 public:
  explicit Collector(const ViewRequest& request)
      : request_(request), repair_(ParseRepair(request.repair, "--repair")) {}

  void Take(const std::string& thing) {
    if (IsFamily(thing) && !std::filesystem::exists(thing)) {
      return TakeSource(SceneSource(thing, request_.root, repair_));
    }
    const std::string extension = Extension(thing);
    if (IsMesh(thing)) return TakeMesh(thing);
    const std::string content = ReadInputFile(thing, kThings, kMaxThingBytes);
    const std::size_t first = content.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) FailUnknown(thing, "an empty file");
    switch (KindOfTable(content)) {
      case TableKind::kMotion:
        return TakeMotion(ParseTraces(content, thing), thing);
      case TableKind::kDepth:
        has_windowless_table_ = true;
        return TakeAnswers(ParseDepthTable(content, thing));
      case TableKind::kQuery:
        return TakeAnswers(ParseQueryTable(content, thing));
      case TableKind::kOther:
        break;
    }
    // Scenes may begin with a comment.
    if (content[first] == '{' || content[first] == '/') {
      return TakeJson(content, thing);
    }
    FailUnknown(thing, extension.empty() || extension == ".json" ||
                               extension == ".jsonl" || extension == ".csv"
                           ? "other content"
                           : "a file " + extension);
  }

  View Finish() {
    const int paths = static_cast<int>(view_.paths.size());
    if (request_.build && stage_ && explored_runs_ > 0 &&
        explored_runs_ == paths) {
      ShowExplored(*stage_, exploring_, UserCache(request_.no_cache), &view_);
    } else if (request_.build && stage_) {
      ShowModel(*stage_, UserCache(request_.no_cache),
                window_runs_ > 0 && window_runs_ == paths, &view_);
    } else if (window_runs_ > 0) {
      view_.notes.push_back("Free space alone was modelled for " +
                            Counted(window_runs_, "run") +
                            " (model window); --build shows what that was.");
    }
    TellOfDepthWindows(has_windowless_table_, &view_);
    if (!request_.robot.empty()) {
      if (!view_.robot.triangles.empty()) {
        throw InputError(
            "--robot: expected things without a robot of their own, found "
            "the scene " +
            scene_);
      }
      view_.robot = Mesh(request_.robot);
    }
    const bool is_fleet =
        !view_.paths.empty() && !view_.paths.front().robot.triangles.empty();
    if (view_.robot.triangles.empty() && !is_fleet &&
        !FirstWay(view_).empty()) {
      view_.notes.push_back(
          "What moves is drawn as a ball: the files do not hold the robot "
          "(--robot FILE).");
    }
    if (view_.meshes.empty() && !FirstWay(view_).empty()) {
      view_.notes.push_back(
          "The files do not hold what stands around: name its mesh or its "
          "scene as well.");
    }
    if (view_.title.empty()) {
      for (const std::string& thing : request_.things) {
        view_.title += (view_.title.empty() ? "" : ", ") +
                       std::filesystem::path(thing).filename().string();
      }
    }
    return std::move(view_);
  }

  const std::optional<ServedScene>& served() const { return served_; }

  // Scenes first: runs find theirs there already.
  static int Order(const std::string& thing) {
    return IsFamily(thing) || Extension(thing) == ".json" ? 0 : 1;
  }

 private:
  static TriangleMesh Mesh(const std::string& path) {
    if (NamesContactSpaceFile(path)) return ReadContactSpace(path).mesh();
    TriangleMesh mesh = LoadMesh(path);
    RequireInRange(mesh, path);
    return mesh;
  }

  void TakeMesh(const std::string& path) {
    const ViewRole role =
        IsMarkedContactSpace(path) ? ViewRole::kContactSpace : ViewRole::kMesh;
    view_.meshes.push_back(
        {std::filesystem::path(path).filename().string(), role, Mesh(path)});
  }

  void TakeSource(const SceneSource& source) {
    if (source.turns()) return TakeTurning(source.LoadTurning());
    TakeScene(source.Load());
  }

  // It has no contact space to build.
  void TakeTurning(const TurningScene& scene) {
    if (request_.build) {
      throw InputError("--build: expected a robot that translates, found " +
                       scene.name + ", of one that turns");
    }
    TakeSceneView(scene.name, TurningSceneView(scene));
    served_ = scene;
  }

  void TakeScene(const Scene& scene) {
    TakeSceneView(scene.name, SceneView(scene));
    stage_ = scene;
    served_ = scene;
  }

  void TakeFleet(const FleetScene& fleet) {
    TakeSceneView(fleet.name, FleetSceneView(fleet));
    served_ = fleet;
  }

  void TakeSceneView(const std::string& name, View view) {
    if (!scene_.empty()) {
      throw InputError("view: expected things of one scene, found " + scene_ +
                       " and " + name + "; look at one at a time");
    }
    scene_ = name;
    view_.title = view.title;
    view_.unit = view.unit;
    view_.robot = view.robot;
    view_.start = view.start;
    view_.goal = view.goal;
    view_.start_turn = view.start_turn;
    view_.goal_turn = view.goal_turn;
    view_.turns = view.turns;
    view_.ends = std::move(view.ends);
    view_.bounds = view.bounds;
    view_.length = view.length;
    Append(&view_.meshes, std::move(view.meshes));
    Append(&view_.paths, std::move(view.paths));
    Append(&view_.movers, std::move(view.movers));
    Append(&view_.notes, std::move(view.notes));
  }

  void TakeMotion(std::vector<ViewTrace> traces, const std::string& file) {
    if (!view_.motion.positions.empty()) {
      throw InputError(file + ": expected one motion, found a second one");
    }
    if (request_.from.has_value() != request_.to.has_value()) {
      throw InputError("--from, --to: expected both or none, found one");
    }
    StraightMotion motion;
    motion.frames = static_cast<int>(traces.front().pd.size());
    if (request_.from) {
      motion.from = *request_.from;
      motion.to = *request_.to;
    } else {
      view_.notes.push_back(
          "The table does not hold the robot's positions: all arrows start at "
          "the origin (--from X Y Z --to X Y Z, as the motion was asked for).");
    }
    for (int frame = 0; frame < motion.frames; ++frame) {
      view_.motion.positions.push_back(motion.At(frame));
    }
    view_.motion.traces = std::move(traces);
  }

  void TakeAnswers(std::vector<ViewAnswer> answers) {
    Append(&view_.answers, std::move(answers));
  }

  // A scene, or objects a line.
  void TakeJson(const std::string& content, const std::string& file) {
    const Json whole = Json::parse(content, nullptr, false, true);
    if (!whole.is_discarded() && !IsRow(whole)) {
      if (HasRobots(whole)) {
        return TakeFleet(
            ParseFleetSceneFile(content, file, request_.root, repair_));
      }
      if (!whole.is_object() || !whole.contains("robot")) {
        FailUnknown(file, "JSON without robot, path or on_a");
      }
      if (HasTurningRobot(whole)) {
        return TakeTurning(
            ParseTurningSceneFile(content, file, request_.root, repair_));
      }
      return TakeScene(ParseSceneFile(content, file, request_.root, repair_));
    }
    std::size_t number = 0;
    for (std::size_t at = 0; at < content.size();) {
      const std::size_t end = std::min(content.find('\n', at), content.size());
      const std::string line = content.substr(at, end - at);
      at = end + 1;
      ++number;
      if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
      TakeRow(line, file + ":" + std::to_string(number));
    }
  }

  static bool IsRow(const Json& json) {
    return json.contains("on_a") || json.contains("signed_distance") ||
           (json.contains("path") && json.contains("scene"));
  }

  void TakeRow(const std::string& line, const std::string& where) {
    const Json row = Json::parse(line, nullptr, false);
    if (row.is_discarded() || !IsRow(row)) {
      FailUnknown(where, row.is_discarded() ? "no JSON" : "another object");
    }
    try {
      if (row.contains("on_a")) {
        view_.answers.push_back(DepthAnswerOf(row));
      } else if (row.contains("signed_distance")) {
        view_.answers.push_back(QueryAnswerOf(row));
      } else {
        TakeRun(row, where);
      }
    } catch (const nlohmann::json::exception& error) {
      throw InputError(where + ": expected a row as phongpd writes it, found " +
                       error.what());
    }
  }

  void TakeRun(const Json& row, const std::string& where) {
    const std::string scene = row.at("scene").get<std::string>();
    const std::uint64_t seed = row.at("seed").get<std::uint64_t>();
    view_.paths.push_back(NamedPathOf(row));
    const bool is_window = row.value("model", "") == "window";
    window_runs_ += is_window ? 1 : 0;
    if (is_window &&
        row.value("planner", "") == ToString(PlannerId::kContactSurface)) {
      ++explored_runs_;
      exploring_ = ExploringRunOf(row);
    }
    if (scene == scene_) return;
    if (!scene_.empty()) {
      throw InputError(where + ": expected runs of the scene " + scene_ +
                       ", found one of " + scene + "; look at one at a time");
    }
    if (IsFamily(scene)) {
      // Seeds of planners draw no scene.
      const bool draws = seed > 0 && !row.contains("planner");
      const SceneSource source(scene, request_.root);
      if (source.turns()) return TakeSource(source);
      return TakeScene(draws ? source.Load(seed) : source.Load());
    }
    scene_ = scene;
    view_.title = scene;
    const Json unit = row.value(Json::json_pointer("/lengths/unit"), Json());
    if (unit.is_string()) view_.unit = unit.get<std::string>();
  }

  template <typename T>
  static void Append(std::vector<T>* all, std::vector<T> more) {
    for (T& item : more) all->push_back(std::move(item));
  }

  const ViewRequest& request_;
  Repair repair_;
  View view_;
  std::string scene_;                  // none yet if empty
  std::optional<Scene> stage_;         // that scene, where it is at hand
  std::optional<ServedScene> served_;  // the same, of whatever kind
  int window_runs_ = 0;                // of the paths
  int explored_runs_ = 0;              // of those, by contact-surface
  ExploringRun exploring_;             // the last of these
  bool has_windowless_table_ = false;
};

}  // namespace

View ReadThings(const ViewRequest& request, std::optional<ServedScene>* scene) {
  std::vector<std::string> things = request.things;
  std::stable_sort(things.begin(), things.end(),
                   [](const std::string& a, const std::string& b) {
                     return Collector::Order(a) < Collector::Order(b);
                   });
  Collector collector(request);
  for (const std::string& thing : things) collector.Take(thing);
  *scene = collector.served();
  return collector.Finish();
}

}  // namespace phongpd::cli
