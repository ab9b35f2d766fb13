// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "core/contact/depth.h"
#include "planners/world/workspace.h"

namespace phongpd {

// A scene file whose `robot` has `turns`: it turns about its own origin as it
// moves.
struct TurningScene {
  std::string name;
  // As of a scene (scene.h); bounds are of the robot's origin.
  Workspace workspace;
  RobotPose start, goal;
  double time_limit = 10.0;  // seconds, of a search
  std::vector<std::string> warnings;
};

// Does the document tell of a robot that turns?
bool HasTurningRobot(const nlohmann::ordered_json& json);

// Of a document as ParseScene takes it.  Throws InputError like that, and for
// keys that only robots have that translate.
TurningScene ParseTurningScene(const nlohmann::ordered_json& json,
                               const std::string& file,
                               const std::string& directory = ".",
                               const std::string& name = "scene",
                               const std::string& root = "",
                               Repair repair = Repair::kReject);

// The same of the file's bytes, as ParseSceneFile.
TurningScene ParseTurningSceneFile(const std::string& text,
                                   const std::string& path,
                                   const std::string& root = "",
                                   Repair repair = Repair::kReject);

}  // namespace phongpd
