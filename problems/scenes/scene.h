// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "constraints/sampling_rule.h"
#include "constraints/trajectory.h"
#include "core/bounds/mesh_repair.h"
#include "core/mesh/mesh_error.h"
#include "core/mesh/triangle_mesh.h"
#include "planners/world/length.h"
#include "planners/world/model.h"
#include "planners/world/moving_obstacle.h"
#include "planners/world/penetration_spec.h"
#include "planners/world/planner_id.h"
#include "planners/world/preset.h"
#include "planners/world/via.h"
#include "planners/world/workspace.h"

// A problem as every command reads it: a robot R that translates, obstacles,
// start and goal, and settings for queries, trajectories and planning.
// Coordinates are in the scene's own unit; settings that are a Length are in
// that unit or shares of D, the one length of the scene's world (world.h).  The
// file format is scene.schema.json.
namespace phongpd {

using IpoptValue = std::variant<int, double, std::string>;

struct TrajectorySettings {
  int waypoints = 40;               // free points between start and goal
  int samples_per_segment = 0;      // interior; 0: by the Lipschitz rule
  Length margin = DefaultMargin();  // distance kept, in (0, D]
  double max_segment_ratio = kMaxSegmentRatio;  // longest over even length
  Model model = Model::kAuto;
  // By Ipopt's own names.  A whole number in the file arrives as an int, also
  // for options that are real numbers.
  std::map<std::string, IpoptValue> ipopt;
};

struct PlanningSettings {
  PlannerId planner = PlannerId::kContactSurface;
  Model model = Model::kAuto;
  double time_limit = 5.0;  // seconds
  // Wanted clearance, in (0, D]: how far paths and samples are lifted off
  // contact where there is room.  None: the planner's own, 0.01 of the diagonal
  // of what it plans in (kEnoughClearance, RetractionOptions).
  std::optional<Length> clearance;
};

struct Scene {
  std::string name;
  Workspace workspace;  // at least one obstacle
  Eigen::Vector3d start = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal = Eigen::Vector3d::Zero();
  Preset preset = Preset::kBalanced;   // of trajectories and plans
  std::optional<MotionLimits> limits;  // none: paths without time
  // Of a motion in time: the places on its way, in order, and the seconds that
  // it takes; 0: as few as can be.
  std::vector<Via> via;
  std::vector<MovingObstacle> moving;  // to keep off, by motions in time only
  double duration = 0.0;
  CurveEnd departure, arrival;  // how it begins and ends
  PenetrationSpec penetration;
  TrajectorySettings trajectory;
  PlanningSettings planning;
  // What the scene's maker knows: whether a path exists, and a free one from
  // start to goal (or none).  Nothing checks either against the solids.
  std::optional<bool> feasible;
  std::vector<Eigen::Vector3d> witness;
  std::vector<std::string> warnings;  // about the solids, one sentence each
};

// The largest scene file that is read.  Arrays and objects may lie within each
// other 100 deep (json_schema.h).
inline constexpr std::uintmax_t kMaxSceneBytes = std::uintmax_t{1} << 28;

// Reads a scene file.  Throws InputError, one line "FILE: /pointer: expected
// ..., found ...": missing or unreadable file, more than kMaxSceneBytes, no
// JSON (comments are allowed), unknown, missing or repeated keys, wrong types,
// numbers out of range or not finite, bounds without inside, equal obstacle
// ids, a rotation that is none, a witness that does not lead from start to
// goal, shapes and mesh files that give no solid.
//
// A `root` that is not empty is a folder that mesh files must lie below, links
// and ".." followed; others are refused before they are opened.  What has been
// checked is what is read, also of files that mesh files name, and only regular
// files are (files_beside.h).
//
// `repair` is for solids without a key of that name
// (core/bounds/mesh_repair.h); what was done is in the warnings, as are meshes
// whose sizes suggest different units.
Scene ReadScene(const std::string& path, const std::string& root = "",
                Repair repair = Repair::kReject);

// The same of the file's bytes.  The path may be of a pipe that they came from:
// then relative mesh paths are from the working directory.
Scene ParseSceneFile(const std::string& text, const std::string& path,
                     const std::string& root = "",
                     Repair repair = Repair::kReject);

// The same from a parsed document; errors start with `file`, mesh paths are
// relative to `directory`.  A scene without a name is called `name`.
Scene ParseScene(const nlohmann::ordered_json& json, const std::string& file,
                 const std::string& directory = ".",
                 const std::string& name = "scene",
                 const std::string& root = "", Repair repair = Repair::kReject);

// "cannot be touched within the bounds, skipped: a, b", for people; empty if
// all of ReachableObstacles (workspace.h).
std::string SkippedObstaclesNote(const Scene& scene);

// scene.schema.json: what a scene file may hold.
const nlohmann::ordered_json& SceneSchema();

}  // namespace phongpd
