// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "core/bounds/mesh_repair.h"
#include "core/mesh/input_file.h"
#include "core/pi.h"
#include "core/solid/solid.h"
#include "planners/world/bare_length.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/files_beside.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/text.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene_schema.h"
#include "problems/scenes/scene_shapes.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

// Every reader below relies on the schema: types, counts and ranges are right.

Vector3d Point(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(),
          value[2].get<double>()};
}

Matrix3d Rotation(const Json& value, const JsonPlace& place) {
  if (value.is_object()) {
    const Vector3d axis = Point(value["axis"]);
    const double length = axis.stableNorm();
    if (!(length > 0.0) || !std::isfinite(length)) {
      place.Child("axis").Fail("a direction", Shortened(value["axis"]));
    }
    constexpr double kRadians = kPi / 180.0;
    return Eigen::AngleAxisd(kRadians * value["degrees"].get<double>(),
                             axis / length)
        .toRotationMatrix();
  }
  Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = value[i].get<double>();
  constexpr double kRounding = 1e-9;  // of 1, for matrices typed by hand
  const double error =
      (rotation * rotation.transpose() - Matrix3d::Identity()).norm();
  // Written so that NaN fails it.
  if (!(error <= kRounding && rotation.determinant() > 0.0)) {
    place.Fail("the rows of a rotation matrix", Shortened(value));
  }
  return rotation;
}

// Where the mesh files of a scene are, and what happens to those that are no
// solids and do not say.
struct MeshFolder {
  std::string directory;  // that relative paths start from
  std::string root;       // that all must lie below, if not empty
  Repair repair = Repair::kReject;
};

Repair RepairOf(const Json& value, const MeshFolder& folder) {
  if (!value.contains("repair")) return folder.repair;
  return ParseRepair(value["repair"].get<std::string>(), "repair");
}

// The path of a mesh file that a scene names, checked against the root.
std::string MeshPath(const Json& value, const JsonPlace& place,
                     const MeshFolder& folder) {
  namespace fs = std::filesystem;
  const std::string text = value.get<std::string>();
  const std::size_t end = FilePartOf(text);
  const std::string part = text.substr(end);  // "#link"
  const fs::path path = fs::path(folder.directory) / text.substr(0, end);
  if (folder.root.empty()) return path.string() + part;
  const std::optional<fs::path> below = PathBelow(path.string(), folder.root);
  if (!below) {
    place.Fail("a mesh file below the root " + folder.root,
               Shortened(value) + ", which is not; move it there");
  }
  return (fs::path(folder.root) / *below).string() + part;
}

// A `solid` of the schema.  Steps that a scene leaves out do no arithmetic.
Solid SolidAt(const Json& value, const JsonPlace& place,
              const MeshFolder& folder, std::vector<std::string>* warnings) {
  TriangleMesh mesh;
  std::string name;
  if (value.contains("shape")) {
    name = place.Child("shape").Text();
    mesh = MakeShape(value["shape"], name);
  } else {
    const JsonPlace mesh_place = place.Child("mesh");
    name = mesh_place.Text();
    const std::string path = MeshPath(value["mesh"], mesh_place, folder);
    try {
      mesh = ReadAnyMesh(path, warnings, folder.root);
    } catch (const InputError& error) {
      throw InputError(name + ": expected a mesh file, found " + error.what());
    }
    name += ": " + Shortened(value["mesh"]);
  }
  if (value.contains("rotation")) {
    mesh = Rotated(std::move(mesh),
                   Rotation(value["rotation"], place.Child("rotation")));
  }
  if (value.contains("scale")) {
    mesh = Scaled(std::move(mesh), value["scale"].get<double>());
  }
  if (value.contains("position")) {
    mesh = Translated(std::move(mesh), Point(value["position"]));
  }
  MeshReport report;
  RepairReport repaired;
  const Solid solid = RepairSolid(mesh, name, RepairOf(value, folder),
                                  kRepairAlpha, &report, &repaired);
  for (const auto* lines : {&repaired.actions, &report.warnings}) {
    for (const std::string& line : *lines) {
      warnings->push_back(name + ": " + line);
    }
  }
  return solid;
}

std::vector<Solid> Obstacles(const Json& value, const JsonPlace& place,
                             const MeshFolder& folder,
                             std::vector<std::string>* warnings) {
  std::set<std::string> ids;
  std::vector<Solid> obstacles;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const JsonPlace here = place.Child(i);
    const std::string id = value[i].value("id", "obstacle" + std::to_string(i));
    if (!ids.insert(id).second) {
      here.Child("id").Fail("an id of its own",
                            Shortened(Json(id)) + " a second time");
    }
    obstacles.push_back(SolidAt(value[i], here, folder, warnings).Named(id));
  }
  return obstacles;
}

// Pieces as they are written of a motion in time.
Trajectory Motion(const Json& value, const JsonPlace& place) {
  std::vector<CurvePiece> pieces;
  for (const Json& piece : value) {
    std::vector<Vector3d> points;
    for (const Json& point : piece["points"]) points.push_back(Point(point));
    const double duration = piece["duration"].get<double>();
    if (!pieces.empty() && pieces.back().back() != points.front()) {
      place.Child(pieces.size())
          .Child("points")
          .Child(std::size_t{0})
          .Fail("the last point of the piece before it",
                Shortened(piece["points"][0]));
    }
    pieces.emplace_back(points, duration);
  }
  return Trajectory(std::move(pieces));
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
         Motion(value[i]["motion"], here.Child("motion"))});
  }
  return moving;
}

BoundingBox Bounds(const Json& value, const JsonPlace& place) {
  const BoundingBox box = {Point(value["min"]), Point(value["max"])};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    place.Child("max")
        .Child(static_cast<std::size_t>(axis))
        .Fail("more than min, " + FormatDouble(box.min[axis]),
              FormatDouble(box.max[axis]));
  }
  return box;
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

// As flags tell them (bare_length.h); a clearance or margin where the range is
// above zero.
Length LengthAt(const Json& value, const JsonPlace& place, LengthRange range,
                const std::string& unit) {
  const std::string text = value.is_string()
                               ? value.get<std::string>()
                               : FormatDouble(value.get<double>());
  if (range == LengthRange::kAboveZero) {
    return ParseClearance(text, place.Text(), 0.0, unit);
  }
  const Length length = ParseLength(text, place.Text(), unit);
  RequireLength(length, range, 0.0, place.Text(), unit);
  return length;
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

MotionLimits Limits(const Json& value, const JsonPlace& place) {
  const bool by_norm = value.value("by", "axis") == "norm";
  const auto limit = [&](const char* key) -> Vector3d {
    const Json& one = value[key];
    if (by_norm && one.is_array()) {
      place.Child(key).Fail("one number with by norm", Shortened(one));
    }
    return one.is_array() ? Point(one) : Vector3d::Constant(one.get<double>());
  };
  MotionLimits limits;
  limits.velocity = limit("velocity");
  limits.acceleration = limit("acceleration");
  limits.jerk = limit("jerk");
  limits.by_norm = by_norm;
  return limits;
}

std::vector<Via> ViaPlaces(const Json& value, const JsonPlace& place,
                           const std::string& unit) {
  std::vector<Via> places;
  for (std::size_t i = 0; i < value.size(); ++i) {
    Via via;
    via.point = Point(value[i]["point"]);
    if (value[i].contains("tolerance")) {
      via.tolerance =
          LengthAt(value[i]["tolerance"], place.Child(i).Child("tolerance"),
                   LengthRange::kAboveZero, unit);
    }
    Read(value[i], "dwell", &via.dwell);
    places.push_back(via);
  }
  return places;
}

CurveEnd EndOf(const Json& value) {
  CurveEnd end;
  if (value.contains("velocity")) end.velocity = Point(value["velocity"]);
  if (value.contains("acceleration")) {
    end.acceleration = Point(value["acceleration"]);
  }
  return end;
}

// Again, now that D is known.
void RequireLengths(const Scene& scene, const JsonPlace& place) {
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
                  place.Child("via").Child(i).Child("tolerance").Text(),
                  scene.workspace.unit);
  }
  if (scene.planning.clearance) {
    require(*scene.planning.clearance, LengthRange::kAboveZero, "planning",
            "clearance");
  }
}

// Shapes are made for each other; files may be in any unit.
void NoteUnits(const Json& json, Scene* scene) {
  const bool is_file = json["robot"].contains("mesh");
  for (std::size_t i = 0; i < scene->workspace.obstacles.size(); ++i) {
    if (!is_file && !json["obstacles"][i].contains("mesh")) continue;
    const Solid& obstacle = scene->workspace.obstacles[i];
    const std::string note = UnitsNote(scene->workspace.robot, "the robot",
                                       obstacle, obstacle.name());
    if (note.empty()) continue;
    scene->warnings.push_back(note);
    return;  // one will do
  }
}

std::vector<Vector3d> Witness(const Json& value, const Scene& scene,
                              const JsonPlace& place) {
  std::vector<Vector3d> points;
  for (const Json& point : value) points.push_back(Point(point));
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
  Scene scene;
  scene.name = json.value("name", name);
  scene.workspace.unit = json.value("unit", "");
  scene.start = Point(json["start"]);
  scene.goal = Point(json["goal"]);
  if (json.contains("bounds")) {
    scene.workspace.bounds = Bounds(json["bounds"], place.Child("bounds"));
  }
  if (json.contains("preset")) {
    scene.preset = ParsePreset(json["preset"].get<std::string>(),
                               place.Child("preset").Text());
  }
  if (json.contains("limits")) {
    scene.limits = Limits(json["limits"], place.Child("limits"));
  }
  if (json.contains("via")) {
    scene.via =
        ViaPlaces(json["via"], place.Child("via"), scene.workspace.unit);
  }
  Read(json, "duration", &scene.duration);
  if (json.contains("departure")) scene.departure = EndOf(json["departure"]);
  if (json.contains("arrival")) scene.arrival = EndOf(json["arrival"]);
  if (json.contains("penetration")) {
    Read(json["penetration"], place.Child("penetration"), scene.workspace.unit,
         &scene.penetration);
  }
  if (json.contains("trajectory")) {
    Read(json["trajectory"], place.Child("trajectory"), scene.workspace.unit,
         &scene.trajectory);
  }
  if (json.contains("planning")) {
    Read(json["planning"], place.Child("planning"), scene.workspace.unit,
         &scene.planning);
  }
  if (json.contains("feasible")) scene.feasible = json["feasible"].get<bool>();
  if (json.contains("witness")) {
    scene.witness = Witness(json["witness"], scene, place.Child("witness"));
  }
  const MeshFolder folder = {directory, root, repair};
  scene.workspace.robot =
      SolidAt(json["robot"], place.Child("robot"), folder, &scene.warnings)
          .Named("robot");
  scene.workspace.obstacles = Obstacles(
      json["obstacles"], place.Child("obstacles"), folder, &scene.warnings);
  if (json.contains("moving")) {
    scene.moving =
        Moving(json["moving"], place.Child("moving"), folder, &scene);
  }
  RequireLengths(scene, place);
  NoteUnits(json, &scene);
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
