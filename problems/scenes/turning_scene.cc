// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/turning_scene.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/meshes/operand_notes.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_parts.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Contact spaces, time and limits are of robots that translate.
void RequireOwnKeys(const Json& json, const JsonPlace& place) {
  for (const char* key :
       {"preset", "limits", "via", "moving", "duration", "departure", "arrival",
        "penetration", "trajectory", "feasible", "witness"}) {
    if (!json.contains(key)) continue;
    place.Child(key).Fail("none of a robot that turns", Shortened(json[key]));
  }
  if (!json.contains("planning")) return;
  for (const auto& [key, value] : json["planning"].items()) {
    if (key == "time_limit") continue;
    place.Child("planning")
        .Child(key)
        .Fail("none of a robot that turns, but a time_limit", Shortened(value));
  }
}

RobotPose PoseAt(const Json& json, const std::string& end,
                 const JsonPlace& place) {
  RobotPose pose;
  pose.position = internal::PointAt(json[end]);
  const std::string key = end + "_rotation";
  if (json.contains(key)) {
    pose.orientation =
        Eigen::Quaterniond(internal::RotationAt(json[key], place.Child(key)))
            .normalized();
  }
  return pose;
}

// Shapes are made for each other; files may be in any unit.
void NoteUnits(const Json& json, TurningScene* scene) {
  for (std::size_t i = 0; i < scene->obstacles.size(); ++i) {
    if (!json["robot"].contains("mesh") &&
        !json["obstacles"][i].contains("mesh")) {
      continue;
    }
    const TurningScene::Obstacle& obstacle = scene->obstacles[i];
    const std::string note =
        UnitsNote(scene->robot, "the robot", obstacle.mesh, obstacle.name);
    if (note.empty()) continue;
    scene->warnings.push_back(note);
    return;  // one will do
  }
}

}  // namespace

bool HasTurningRobot(const Json& json) {
  return json.is_object() && json.contains("robot") &&
         json["robot"].is_object() && json["robot"].contains("turns") &&
         json["robot"]["turns"] == true;
}

TurningScene ParseTurningScene(const Json& json, const std::string& file,
                               const std::string& directory,
                               const std::string& name, const std::string& root,
                               Repair repair) {
  RequireSchema(json, SceneSchema(), file);
  const JsonPlace place = {file, ""};
  if (!HasTurningRobot(json)) {
    place.Child("robot").Fail("\"turns\": true", "a robot that translates");
  }
  RequireOwnKeys(json, place);
  const internal::MeshFolder folder = {directory, root, repair};
  Scene read;
  internal::ReadSettings(json, place, &read);
  TurningScene scene;
  scene.name = json.value("name", name);
  scene.unit = read.workspace.unit;
  scene.bounds = read.workspace.bounds;
  scene.robot = internal::SurfaceAt(json["robot"], place.Child("robot"), folder,
                                    &scene.warnings);
  std::set<std::string> ids;
  const JsonPlace all = place.Child("obstacles");
  for (std::size_t i = 0; i < json["obstacles"].size(); ++i) {
    const Json& value = json["obstacles"][i];
    const JsonPlace here = all.Child(i);
    std::string id = internal::ObstacleId(value, i, here, &ids);
    scene.obstacles.push_back(
        {std::move(id),
         internal::SurfaceAt(value, here, folder, &scene.warnings)});
  }
  NoteUnits(json, &scene);
  scene.start = PoseAt(json, "start", place);
  scene.goal = PoseAt(json, "goal", place);
  if (json.contains("planning") && json["planning"].contains("time_limit")) {
    scene.time_limit = read.planning.time_limit;
  }
  return scene;
}

TurningScene ParseTurningSceneFile(const std::string& text,
                                   const std::string& path,
                                   const std::string& root, Repair repair) {
  const std::filesystem::path file(path);
  const bool has_folder = std::filesystem::is_regular_file(file);
  return ParseTurningScene(ParseJson(text, path), path,
                           has_folder ? file.parent_path().string() : ".",
                           has_folder ? file.stem().string() : "scene", root,
                           repair);
}

}  // namespace phongpd
