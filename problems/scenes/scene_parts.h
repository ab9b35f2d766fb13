// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"

// Of what scene files consist, of one robot (scene.h) several
// (fleet_scene.h), or one that turns (turning_scene.h).  Every reader relies on
// the schema: types, counts and ranges are right.  All throw InputError at
// their place for the rest.
namespace phongpd::internal {

// Where the mesh files of a scene are, and what happens to those that are no
// solids and do not say.
struct MeshFolder {
  std::string directory;  // that relative paths start from
  std::string root;       // that all must lie below, if not empty
  Repair repair = Repair::kReject;
};

Eigen::Vector3d PointAt(const nlohmann::ordered_json& value);

Eigen::Matrix3d RotationAt(const nlohmann::ordered_json& value,
                           const JsonPlace& place);

// A `solid` of the schema.  Steps that a scene leaves out do no arithmetic.
Solid SolidAt(const nlohmann::ordered_json& value, const JsonPlace& place,
              const MeshFolder& folder, std::vector<std::string>* warnings);

// The same of what RigidJudge takes, a surface: the solid where it is one, else
// the triangles as they are, which a warning tells with the defect.  A repair
// that is asked for has to succeed.
TriangleMesh SurfaceAt(const nlohmann::ordered_json& value,
                       const JsonPlace& place, const MeshFolder& folder,
                       std::vector<std::string>* warnings);

// The id of obstacle `i`, one that none of *ids is; adds it.
std::string ObstacleId(const nlohmann::ordered_json& value, std::size_t i,
                       const JsonPlace& place, std::set<std::string>* ids);

// Pieces as they are written of a motion in time.
Trajectory MotionAt(const nlohmann::ordered_json& value,
                    const JsonPlace& place);

BoundingBox BoundsAt(const nlohmann::ordered_json& value,
                     const JsonPlace& place);
MotionLimits LimitsAt(const nlohmann::ordered_json& value,
                      const JsonPlace& place);
std::vector<Via> ViaAt(const nlohmann::ordered_json& value,
                       const JsonPlace& place, const std::string& unit);
CurveEnd EndAt(const nlohmann::ordered_json& value);

// As flags tell them (bare_length.h); a clearance or margin where the range is
// above zero.
Length LengthAt(const nlohmann::ordered_json& value, const JsonPlace& place,
                LengthRange range, const std::string& unit);

// What does not belong to a robot: unit, bounds, preset, limits and settings.
void ReadSettings(const nlohmann::ordered_json& json, const JsonPlace& place,
                  Scene* scene);
// Obstacles, fixed and moving.
void ReadSurroundings(const nlohmann::ordered_json& json,
                      const JsonPlace& place, const MeshFolder& folder,
                      Scene* scene);
// What a robot is to do: start, goal and what lies between.
void ReadTask(const nlohmann::ordered_json& value, const JsonPlace& place,
              Scene* scene);

// Are the lengths in range, now that D is known?  `task` is where ReadTask
// read.
void RequireLengths(const Scene& scene, const JsonPlace& place,
                    const JsonPlace& task);

// Warns where the meshes' sizes suggest different units; of robot and obstacles
// as they are written.
void NoteUnits(const nlohmann::ordered_json& robot,
               const nlohmann::ordered_json& obstacles, Scene* scene);

}  // namespace phongpd::internal
