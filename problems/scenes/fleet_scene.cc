// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/fleet_scene.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_parts.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;

// Files of answers are called by them.
bool IsFileName(const std::string& id) {
  return std::all_of(id.begin(), id.end(), [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') ||
           ('0' <= c && c <= '9') || c == '-' || c == '_';
  });
}

void RequireTasksAreRobots(const Json& json, const JsonPlace& place) {
  for (const char* key : {"start", "goal", "via", "duration", "departure",
                          "arrival", "feasible", "witness"}) {
    if (!json.contains(key)) continue;
    place.Child(key).Fail("none beside \"robots\", each of which has its own",
                          Shortened(json[key]));
  }
}

std::string IdOf(const Json& robot, std::size_t i, const JsonPlace& place,
                 std::set<std::string>* ids) {
  std::string id = robot.value("id", "robot" + std::to_string(i));
  if (!IsFileName(id)) {
    place.Child("id").Fail("letters, digits, - and _, as files are named by it",
                           Shortened(Json(id)));
  }
  if (!ids->insert(id).second) {
    place.Child("id").Fail("an id of its own",
                           Shortened(Json(id)) + " a second time");
  }
  return id;
}

Json SolidOf(const Json& robot) {
  Json solid = Json::object();
  for (const char* key :
       {"shape", "mesh", "repair", "position", "scale", "rotation"}) {
    if (robot.contains(key)) solid[key] = robot[key];
  }
  return solid;
}

}  // namespace

bool HasRobots(const Json& json) {
  return json.is_object() && json.contains("robots");
}

FleetScene ParseFleetScene(const Json& json, const std::string& file,
                           const std::string& directory,
                           const std::string& name, const std::string& root,
                           Repair repair) {
  RequireSchema(json, SceneSchema(), file);
  const JsonPlace place = {file, ""};
  if (!HasRobots(json)) place.Fail("\"robots\"", "one \"robot\"");
  RequireTasksAreRobots(json, place);
  FleetScene fleet;
  fleet.name = json.value("name", name);
  const internal::MeshFolder folder = {directory, root, repair};
  Scene common;
  common.name = fleet.name;
  internal::ReadSettings(json, place, &common);
  internal::ReadSurroundings(json, place, folder, &common);
  std::set<std::string> ids;
  for (const Solid& solid : common.workspace.obstacles) {
    ids.insert(solid.name());
  }
  for (const MovingObstacle& one : common.moving) {
    ids.insert(one.solid.name());
  }
  for (std::size_t i = 0; i < json["robots"].size(); ++i) {
    const Json& value = json["robots"][i];
    const JsonPlace here = place.Child("robots").Child(i);
    Scene scene = common;
    const std::string id = IdOf(value, i, here, &ids);
    scene.workspace.robot =
        internal::SolidAt(SolidOf(value), here, folder, &scene.warnings)
            .Named(id);
    internal::ReadTask(value, here, &scene);
    if (value.contains("bounds")) {
      scene.workspace.bounds =
          internal::BoundsAt(value["bounds"], here.Child("bounds"));
    }
    if (value.contains("limits")) {
      scene.limits = internal::LimitsAt(value["limits"], here.Child("limits"));
    }
    internal::RequireLengths(scene, place, here);
    internal::NoteUnits(value, json["obstacles"], &scene);
    fleet.robots.push_back(std::move(scene));
    common.warnings.clear();
  }
  return fleet;
}

FleetScene ParseFleetSceneFile(const std::string& text, const std::string& path,
                               const std::string& root, Repair repair) {
  const std::filesystem::path file(path);
  const bool has_folder = std::filesystem::is_regular_file(file);
  return ParseFleetScene(ParseJson(text, path), path,
                         has_folder ? file.parent_path().string() : ".",
                         has_folder ? file.stem().string() : "scene", root,
                         repair);
}

}  // namespace phongpd
