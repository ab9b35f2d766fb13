// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_parts.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/bounds/mesh_repair.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/mesh_range.h"
#include "core/pi.h"
#include "planners/world/bare_length.h"
#include "problems/meshes/any_mesh.h"
#include "problems/meshes/files_beside.h"
#include "problems/meshes/operand_notes.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_shapes.h"

namespace phongpd::internal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

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

// What is written of a solid, in its place; steps that a scene leaves out do no
// arithmetic.
struct PlacedMesh {
  std::string name;
  TriangleMesh mesh;
};

PlacedMesh MeshAt(const Json& value, const JsonPlace& place,
                  const MeshFolder& folder,
                  std::vector<std::string>* warnings) {
  PlacedMesh placed;
  std::string& name = placed.name;
  TriangleMesh& mesh = placed.mesh;
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
      throw InputError(name + ": " + error.what());
    }
    name += ": " + Shortened(value["mesh"]);
  }
  if (value.contains("rotation")) {
    mesh = Rotated(std::move(mesh),
                   RotationAt(value["rotation"], place.Child("rotation")));
  }
  if (value.contains("scale")) {
    mesh = Scaled(std::move(mesh), value["scale"].get<double>());
  }
  if (value.contains("position")) {
    mesh = Translated(std::move(mesh), PointAt(value["position"]));
  }
  return placed;
}

Solid SolidOf(const PlacedMesh& placed, Repair repair,
              std::vector<std::string>* warnings) {
  MeshReport report;
  RepairReport repaired;
  const Solid solid = RepairSolid(placed.mesh, placed.name, repair,
                                  kRepairAlpha, &report, &repaired);
  for (const auto* lines : {&repaired.actions, &report.warnings}) {
    for (const std::string& line : *lines) {
      warnings->push_back(placed.name + ": " + line);
    }
  }
  return solid;
}

}  // namespace

Vector3d PointAt(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(),
          value[2].get<double>()};
}

Matrix3d RotationAt(const Json& value, const JsonPlace& place) {
  if (value.is_object()) {
    const Vector3d axis = PointAt(value["axis"]);
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

Solid SolidAt(const Json& value, const JsonPlace& place,
              const MeshFolder& folder, std::vector<std::string>* warnings) {
  return SolidOf(MeshAt(value, place, folder, warnings),
                 RepairOf(value, folder), warnings);
}

TriangleMesh SurfaceAt(const Json& value, const JsonPlace& place,
                       const MeshFolder& folder,
                       std::vector<std::string>* warnings) {
  PlacedMesh placed = MeshAt(value, place, folder, warnings);
  const Repair repair = RepairOf(value, folder);
  if (repair != Repair::kReject) return SolidOf(placed, repair, warnings);
  // What is no surface either: the judge has no names.
  RequireInRange(placed.mesh, placed.name);
  try {
    return SolidOf(placed, repair, warnings);
  } catch (const InputError& error) {
    warnings->push_back(std::string(error.what()) +
                        "; its triangles are judged as they are, and have an "
                        "inside only if they are closed");
    return std::move(placed.mesh);
  }
}

std::string ObstacleId(const Json& value, std::size_t i, const JsonPlace& place,
                       std::set<std::string>* ids) {
  const std::string id = value.value("id", "obstacle" + std::to_string(i));
  if (!ids->insert(id).second) {
    place.Child("id").Fail("an id of its own",
                           Shortened(Json(id)) + " a second time");
  }
  return id;
}

// Pieces as they are written of a motion in time.
Trajectory MotionAt(const Json& value, const JsonPlace& place) {
  std::vector<CurvePiece> pieces;
  for (const Json& piece : value) {
    std::vector<Vector3d> points;
    for (const Json& point : piece["points"]) points.push_back(PointAt(point));
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

BoundingBox BoundsAt(const Json& value, const JsonPlace& place) {
  const BoundingBox box = {PointAt(value["min"]), PointAt(value["max"])};
  for (int axis = 0; axis < 3; ++axis) {
    if (box.min[axis] < box.max[axis]) continue;
    place.Child("max")
        .Child(static_cast<std::size_t>(axis))
        .Fail("more than min, " + FormatDouble(box.min[axis]),
              FormatDouble(box.max[axis]));
  }
  return box;
}

// As flags tell them (bare_length.h); a clearance or margin where the range is
// above zero.
Length LengthAt(const Json& value, const JsonPlace& place, LengthRange range,
                const std::string& unit) {
  const std::string what = place.Text();
  if (value.is_string() && range == LengthRange::kAboveZero) {
    return ParseClearance(value.get<std::string>(), what, 0.0, unit);
  }
  const Length length = value.is_string()
                            ? ParseLength(value.get<std::string>(), what, unit)
                            : BareLength(value.get<double>(), unit);
  if (range == LengthRange::kAboveZero) {
    RequireClearance(length, true, what, 0.0, unit);
  } else {
    RequireLength(length, range, 0.0, what, unit);
  }
  return length;
}

MotionLimits LimitsAt(const Json& value, const JsonPlace& place) {
  const bool by_norm = value.value("by", "axis") == "norm";
  const auto limit = [&](const char* key) -> Vector3d {
    const Json& one = value[key];
    if (by_norm && one.is_array()) {
      place.Child(key).Fail("one number with by norm", Shortened(one));
    }
    return one.is_array() ? PointAt(one)
                          : Vector3d::Constant(one.get<double>());
  };
  MotionLimits limits;
  limits.velocity = limit("velocity");
  limits.acceleration = limit("acceleration");
  limits.jerk = limit("jerk");
  limits.by_norm = by_norm;
  return limits;
}

std::vector<Via> ViaAt(const Json& value, const JsonPlace& place,
                       const std::string& unit) {
  std::vector<Via> places;
  for (std::size_t i = 0; i < value.size(); ++i) {
    Via via;
    via.point = PointAt(value[i]["point"]);
    if (value[i].contains("tolerance")) {
      via.tolerance =
          LengthAt(value[i]["tolerance"], place.Child(i).Child("tolerance"),
                   LengthRange::kAboveZero, unit);
    }
    if (value[i].contains("dwell")) via.dwell = value[i]["dwell"].get<double>();
    places.push_back(via);
  }
  return places;
}

CurveEnd EndAt(const Json& value) {
  CurveEnd end;
  if (value.contains("velocity")) end.velocity = PointAt(value["velocity"]);
  if (value.contains("acceleration")) {
    end.acceleration = PointAt(value["acceleration"]);
  }
  return end;
}

}  // namespace phongpd::internal
