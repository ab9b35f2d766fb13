// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "constraints/sampling_rule.h"
#include "constraints/trajectory.h"
#include "core/bounds/mesh_repair.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/world/ipopt_value.h"
#include "planners/world/length.h"
#include "planners/world/model.h"
#include "planners/world/moving_obstacle.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/planner_id.h"
#include "planners/world/preset.h"
#include "planners/world/via.h"
#include "planners/world/workspace.h"

// A problem in a file, as every command of the program reads it: a robot that
// translates, obstacles, start and goal, and settings for queries, trajectories
// and planning.  Coordinates are in the scene's own unit.  A setting that is a
// Length is in that unit, or a share of D, the one length of the scene's world
// (planners/world/world.h).  The file format is scene.schema.json.  For several
// robots: fleet_scene.h.
namespace phongpd {

struct TrajectorySettings {
  int waypoints = 40;  // free points between start and goal
  // Samples inside a segment; 0: as many as the rule says (sampling_rule.h).
  int samples_per_segment = 0;
  Length margin = DefaultMargin();  // distance to keep from contact, in (0, D]
  // The longest segment allowed, over the length of even segments.
  double max_segment_ratio = kMaxSegmentRatio;
  Model model = Model::kAuto;
  // Ipopt's own options.  A whole number in the file is an int here, even if
  // Ipopt's option is a real number.
  IpoptValues ipopt;
};

struct PlanningSettings {
  PlannerId planner = PlannerId::kContactSurface;
  Model model = Model::kAuto;
  double time_limit = 5.0;  // seconds
  // Wanted clearance, in (0, D]: how far paths and samples are moved away from
  // contact where there is room.  None: the planner's default, 0.01 of the
  // diagonal of its region (kEnoughClearance, RetractionOptions).
  std::optional<Length> clearance;
};

struct Scene {
  std::string name;
  Workspace workspace;  // at least one obstacle
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  Preset preset = Preset::kBalanced;   // for trajectories and plans
  std::optional<MotionLimits> limits;  // none: paths without time
  // For motions in time only:
  std::vector<Via> via;                // places on the way, in order
  std::vector<MovingObstacle> moving;  // obstacles that move
  double duration = 0.0;               // seconds; 0: as short as possible
  CurveEnd departure, arrival;         // velocity, acceleration at both ends
  PenetrationSpec penetration;
  TrajectorySettings trajectory;
  PlanningSettings planning;
  // What the author of the scene knows: does a path exist, and a free path from
  // start to goal (empty: not given).  Neither is checked against the solids.
  std::optional<bool> feasible;
  std::vector<Eigen::Vector3d> witness;
  std::vector<std::string> warnings;  // about the solids, one sentence each
};

// The largest scene file that is read, 256 MiB.  Arrays and objects may be
// nested 100 deep (json_schema.h).
inline constexpr std::uintmax_t kMaxSceneBytes = std::uintmax_t{1} << 28;

// Reads a scene file.  Mesh paths are relative to its folder.
//
// For scenes from strangers: if `root` is not empty, all mesh files must be
// regular files below that folder, after following links and ".."; others are
// refused before they are opened.  The same holds for files that mesh files
// name, and nobody can exchange a file between check and reading
// (files_beside.h).
//
// `repair` says what is done with meshes that are not solids, if the solid has
// no key `repair` in the file (core/bounds/mesh_repair.h).  The warnings tell
// what was done, and which meshes seem to be in different units.
//
// Throws InputError, one line "FILE: /pointer: expected ..., found ...", for a
// file that is missing, unreadable or larger than kMaxSceneBytes, or is not
// JSON (comments are allowed); for unknown, missing or repeated keys, wrong
// types, and numbers out of range or not finite; for bounds without a point
// inside, equal ids of obstacles, a matrix that is not a rotation, and a
// witness that does not lead from start to goal; and for shapes and mesh files
// that do not give a solid.
Scene ReadScene(const std::string& path, const std::string& root = "",
                Repair repair = Repair::kReject);

// The same from the bytes of a file.  If `path` is a pipe's, mesh paths are
// relative to the working directory.
Scene ParseSceneFile(const std::string& text, const std::string& path,
                     const std::string& root = "",
                     Repair repair = Repair::kReject);

// The same from a parsed document.  Messages begin with `file`; mesh paths are
// relative to `directory`; `name` is the scene's name if it has none itself.
Scene ParseScene(const nlohmann::ordered_json& json, const std::string& file,
                 const std::string& directory = ".",
                 const std::string& name = "scene",
                 const std::string& root = "", Repair repair = Repair::kReject);

// A note for people, "cannot be touched within the bounds, skipped: a, b";
// empty if the robot can reach all obstacles (ReachableObstacles, workspace.h).
std::string SkippedObstaclesNote(const Scene& scene);

// The JSON schema of scene files, scene.schema.json.
const nlohmann::ordered_json& SceneSchema();

}  // namespace phongpd
