// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/bounds/mesh_repair.h"
#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A scene whose `robot` has `turns`: it turns about its own origin as it moves.
// Motions are judged by surfaces, which need not be closed (rigid_judge.h).
struct TurningScene {
  struct Obstacle {
    std::string name;  // of its own
    TriangleMesh mesh;
  };

  std::string name;
  std::string unit;  // one of UnitNames (length.h); empty: it has no name
  TriangleMesh robot;
  std::vector<Obstacle> obstacles;                     // one at least
  BoundingBox bounds = ComputeBounds(TriangleMesh());  // of the robot's
                                                       // origin; empty: none
  RobotPose start, goal;
  double time_limit = 10.0;           // seconds, of a search
  std::vector<std::string> warnings;  // one sentence each, of open surfaces too
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
