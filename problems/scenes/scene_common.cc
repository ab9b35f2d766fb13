// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/mesh/mesh_error.h"
#include "planners/world/bare_length.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_parts.h"

namespace phongpd::internal {
namespace {

using Json = nlohmann::ordered_json;

// Every reader below relies on the schema: types, counts and ranges are right.

std::vector<Solid> Obstacles(const Json& value, const JsonPlace& place,
                             const MeshFolder& folder,
                             std::vector<std::string>* warnings) {
  std::set<std::string> ids;
  std::vector<Solid> obstacles;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const JsonPlace here = place.Child(i);
    const std::string id = ObstacleId(value[i], i, here, &ids);
    obstacles.push_back(SolidAt(value[i], here, folder, warnings).Named(id));
  }
  return obstacles;
}

std::vector<MovingObstacle> Moving(const Json& value, const JsonPlace& place,
                                   const MeshFolder& folder, Scene* scene) {
  std::set<std::string> ids;
  for (const Solid& obstacle : scene->workspace.obstacles) {
    ids.insert(obstacle.name());
  }
  std::vector<MovingObstacle> moving;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const JsonPlace here = place.Child(i);
    const std::string id = value[i].value("id", "moving" + std::to_string(i));
    if (!ids.insert(id).second) {
      here.Child("id").Fail("an id of its own",
                            Shortened(Json(id)) + " a second time");
    }
    moving.push_back(
        {SolidAt(value[i], here, folder, &scene->warnings).Named(id),
         MotionAt(value[i]["motion"], here.Child("motion"))});
  }
  return moving;
}

// One of several words.
template <typename Parse, typename Kind>
void Read(const Json& value, const JsonPlace& place, const char* key,
          const Parse& parse, Kind* kind) {
  if (!value.contains(key)) return;
  *kind = parse(value[key].get<std::string>(), place.Child(key).Text());
}

void Read(const Json& value, const char* key, double* number) {
  if (value.contains(key)) *number = value[key].get<double>();
}

void Read(const Json& value, const char* key, int* number) {
  // By way of double: 40.0 is a whole number too.
  if (value.contains(key)) *number = static_cast<int>(value[key].get<double>());
}

void Read(const Json& value, const JsonPlace& place, const std::string& unit,
          PenetrationSpec* settings) {
  Read(value, place, "metric", ParseMetricKind, &settings->metric);
  Read(value, place, "field", ParseFieldKind, &settings->field);
  if (value.contains("smoothing_length")) {
    settings->smoothing_length =
        LengthAt(value["smoothing_length"], place.Child("smoothing_length"),
                 LengthRange::kFromZero, unit);
  }
  Read(value, place, "jacobian", ParseJacobianKind, &settings->jacobian);
}

IpoptValue OptionValue(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  const double number = value.get<double>();
  constexpr double kLargestInt = 2147483647.0;
  if (value.is_number_integer() && std::abs(number) <= kLargestInt) {
    return static_cast<int>(number);
  }
  return number;
}

void Read(const Json& value, const JsonPlace& place, const std::string& unit,
          TrajectorySettings* settings) {
  Read(value, "waypoints", &settings->waypoints);
  Read(value, "samples_per_segment", &settings->samples_per_segment);
  if (value.contains("margin")) {
    settings->margin = LengthAt(value["margin"], place.Child("margin"),
                                LengthRange::kAboveZero, unit);
  }
  Read(value, "max_segment_ratio", &settings->max_segment_ratio);
  Read(value, place, "model", ParseModel, &settings->model);
  if (!value.contains("ipopt")) return;
  for (const auto& [key, option] : value["ipopt"].items()) {
    settings->ipopt[key] = OptionValue(option);
  }
}

void Read(const Json& value, const JsonPlace& place, const std::string& unit,
          PlanningSettings* settings) {
  Read(value, place, "planner", ParsePlanner, &settings->planner);
  Read(value, place, "model", ParseModel, &settings->model);
  Read(value, "time_limit", &settings->time_limit);
  if (value.contains("clearance")) {
    settings->clearance = LengthAt(value["clearance"], place.Child("clearance"),
                                   LengthRange::kAboveZero, unit);
  }
}

}  // namespace

void ReadSettings(const Json& json, const JsonPlace& place, Scene* scene) {
  const std::string& unit = scene->workspace.unit = json.value("unit", "");
  if (json.contains("bounds")) {
    scene->workspace.bounds = BoundsAt(json["bounds"], place.Child("bounds"));
  }
  if (json.contains("preset")) {
    scene->preset = ParsePreset(json["preset"].get<std::string>(),
                                place.Child("preset").Text());
  }
  if (json.contains("limits")) {
    scene->limits = LimitsAt(json["limits"], place.Child("limits"));
  }
  if (json.contains("penetration")) {
    Read(json["penetration"], place.Child("penetration"), unit,
         &scene->penetration);
  }
  if (json.contains("trajectory")) {
    Read(json["trajectory"], place.Child("trajectory"), unit,
         &scene->trajectory);
  }
  if (json.contains("planning")) {
    Read(json["planning"], place.Child("planning"), unit, &scene->planning);
  }
}

void ReadSurroundings(const Json& json, const JsonPlace& place,
                      const MeshFolder& folder, Scene* scene) {
  scene->workspace.obstacles = Obstacles(
      json["obstacles"], place.Child("obstacles"), folder, &scene->warnings);
  if (json.contains("moving")) {
    scene->moving =
        Moving(json["moving"], place.Child("moving"), folder, scene);
  }
}

void ReadTask(const Json& value, const JsonPlace& place, Scene* scene) {
  scene->start = PointAt(value["start"]);
  scene->goal = PointAt(value["goal"]);
  if (value.contains("via")) {
    scene->via = ViaAt(value["via"], place.Child("via"), scene->workspace.unit);
  }
  Read(value, "duration", &scene->duration);
  if (value.contains("departure")) scene->departure = EndAt(value["departure"]);
  if (value.contains("arrival")) scene->arrival = EndAt(value["arrival"]);
}

// Again, now that D is known.
void RequireLengths(const Scene& scene, const JsonPlace& place,
                    const JsonPlace& task) {
  const double diagonal = ContactBounds(scene.workspace).Diagonal();
  const auto require = [&](const Length& length, LengthRange range,
                           const char* section, const char* key) {
    RequireLength(length, range, diagonal,
                  place.Child(section).Child(key).Text(), scene.workspace.unit);
  };
  require(scene.penetration.smoothing_length, LengthRange::kFromZero,
          "penetration", "smoothing_length");
  require(scene.trajectory.margin, LengthRange::kAboveZero, "trajectory",
          "margin");
  for (std::size_t i = 0; i < scene.via.size(); ++i) {
    RequireLength(scene.via[i].tolerance, LengthRange::kAboveZero, diagonal,
                  task.Child("via").Child(i).Child("tolerance").Text(),
                  scene.workspace.unit);
  }
  if (scene.planning.clearance) {
    require(*scene.planning.clearance, LengthRange::kAboveZero, "planning",
            "clearance");
  }
}

// Shapes are made for each other; files may be in any unit.
void NoteUnits(const Json& robot, const Json& obstacles, Scene* scene) {
  const bool is_file = robot.contains("mesh");
  for (std::size_t i = 0; i < scene->workspace.obstacles.size(); ++i) {
    if (!is_file && !obstacles[i].contains("mesh")) continue;
    const Solid& obstacle = scene->workspace.obstacles[i];
    const std::string note = UnitsNote(scene->workspace.robot,
                                       scene->workspace.robot.name() == "robot"
                                           ? "the robot"
                                           : scene->workspace.robot.name(),
                                       obstacle, obstacle.name());
    if (note.empty()) continue;
    scene->warnings.push_back(note);
    return;  // one will do
  }
}

}  // namespace phongpd::internal
