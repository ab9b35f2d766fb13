// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// A scene file with `robots` in place of `robot`: several that move at once.
struct FleetScene {
  std::string name;
  // One scene for each robot, which is called by its id there: all have the
  // same obstacles, fixed and moving, and settings, but ends, places on the
  // way, limits and bounds of their own.  Warnings about what they share are in
  // the first.
  std::vector<Scene> robots;
};

// Does the document tell of several robots, even if wrongly?
bool HasRobots(const nlohmann::ordered_json& json);

// Of a document as ParseScene takes it.  Throws InputError like that, and where
// ids are equal or are no names of files (letters, digits, - and _), where a
// key that is each robot's own stands beside `robots`.
FleetScene ParseFleetScene(const nlohmann::ordered_json& json,
                           const std::string& file,
                           const std::string& directory = ".",
                           const std::string& name = "scene",
                           const std::string& root = "",
                           Repair repair = Repair::kReject);

// The same of the file's bytes, as ParseSceneFile.
FleetScene ParseFleetSceneFile(const std::string& text, const std::string& path,
                               const std::string& root = "",
                               Repair repair = Repair::kReject);

}  // namespace phongpd
