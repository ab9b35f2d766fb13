// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// A scene of several robots that move at the same time, for OptimizeFleet
// (planners/solve/fleet.h).  In the file, `robots` takes the place of `robot`.
struct FleetScene {
  std::string name;
  // One scene for each robot; its name is the robot's id.  All have the same
  // obstacles, fixed and moving, and the same settings.  Start, goal, places on
  // the way, limits and bounds are each robot's own.  Warnings about what they
  // share are in the first scene only.
  std::vector<Scene> robots;
};

// Does the document have the key `robots`?  Its value may still be wrong.
bool HasRobots(const nlohmann::ordered_json& json);

// The scenes of a parsed document; the arguments are those of ParseScene.
// Throws InputError like ParseScene; for two equal ids; for an id that is not
// made of letters, digits, - and _ (it becomes part of file names); and for a
// key beside `robots` that belongs to each robot.
FleetScene ParseFleetScene(const nlohmann::ordered_json& json,
                           const std::string& file,
                           const std::string& directory = ".",
                           const std::string& name = "scene",
                           const std::string& root = "",
                           Repair repair = Repair::kReject);

// The same from the bytes of a file; the arguments are those of ParseSceneFile.
FleetScene ParseFleetSceneFile(const std::string& text, const std::string& path,
                               const std::string& root = "",
                               Repair repair = Repair::kReject);

}  // namespace phongpd
