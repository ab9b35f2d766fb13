// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/mesh/input_file.h"
#include "problems/output/text.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_parts.h"
#include "problems/scenes/scene_schema.h"
#include "problems/scenes/turning_scene.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

std::vector<Vector3d> Witness(const Json& value, const Scene& scene,
                              const JsonPlace& place) {
  std::vector<Vector3d> points;
  for (const Json& point : value) points.push_back(internal::PointAt(point));
  if (points.front() != scene.start) {
    place.Child(std::size_t{0}).Fail("the start", Shortened(value.front()));
  }
  if (points.back() != scene.goal) {
    place.Child(points.size() - 1).Fail("the goal", Shortened(value.back()));
  }
  return points;
}

}  // namespace

const Json& SceneSchema() {
  // Never destroyed: that takes memory, of which there may be none by then.
  static const Json& schema = *new Json(Json::parse(internal::kSceneSchema));
  return schema;
}

Scene ParseScene(const Json& json, const std::string& file,
                 const std::string& directory, const std::string& name,
                 const std::string& root, Repair repair) {
  RequireSchema(json, SceneSchema(), file);
  const JsonPlace place = {file, ""};
  if (json.contains("robots")) {
    place.Child("robots").Fail(
        "one robot here, as \"robot\"",
        "a list of " + std::to_string(json["robots"].size()) +
            "; motions of several are found by phongpd optimize");
  }
  if (HasTurningRobot(json)) {
    place.Child("robot").Child("turns").Fail(
        "a robot that translates here",
        "true; motions of one that turns are found by phongpd plan");
  }
  for (const char* key : {"start_rotation", "goal_rotation"}) {
    if (!json.contains(key)) continue;
    place.Child(key).Fail("none of a robot without \"turns\": true",
                          Shortened(json[key]));
  }
  Scene scene;
  scene.name = json.value("name", name);
  internal::ReadSettings(json, place, &scene);
  internal::ReadTask(json, place, &scene);
  if (json.contains("feasible")) scene.feasible = json["feasible"].get<bool>();
  if (json.contains("witness")) {
    scene.witness = Witness(json["witness"], scene, place.Child("witness"));
  }
  const internal::MeshFolder folder = {directory, root, repair};
  scene.workspace.robot = internal::SolidAt(json["robot"], place.Child("robot"),
                                            folder, &scene.warnings)
                              .Named("robot");
  internal::ReadSurroundings(json, place, folder, &scene);
  internal::RequireLengths(scene, place, place);
  internal::NoteUnits(json["robot"], json["obstacles"], &scene);
  return scene;
}

Scene ReadScene(const std::string& path, const std::string& root,
                Repair repair) {
  return ParseSceneFile(ReadInputFile(path, "a scene file", kMaxSceneBytes),
                        path, root, repair);
}

Scene ParseSceneFile(const std::string& text, const std::string& path,
                     const std::string& root, Repair repair) {
  const std::filesystem::path file(path);
  const bool has_folder = std::filesystem::is_regular_file(file);
  return ParseScene(ParseJson(text, path), path,
                    has_folder ? file.parent_path().string() : ".",
                    has_folder ? file.stem().string() : "scene", root, repair);
}

std::string SkippedObstaclesNote(const Scene& scene) {
  const std::vector<int> relevant = ReachableObstacles(scene.workspace);
  const std::set<int> kept(relevant.begin(), relevant.end());
  std::string list;
  for (std::size_t i = 0; i < scene.workspace.obstacles.size(); ++i) {
    if (kept.count(static_cast<int>(i)) > 0) continue;
    list += (list.empty() ? "" : ", ") + scene.workspace.obstacles[i].name();
  }
  if (list.empty()) return list;
  return "cannot be touched within the bounds, skipped: " + list;
}

}  // namespace phongpd
