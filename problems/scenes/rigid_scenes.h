// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "core/mesh/triangle_mesh.h"

// Problems for a robot that turns, after those of the field, made here: solids,
// closed, with a knob for how tight they are.  Nothing is read, nothing of
// others is shipped.  Commands take them as scenes (turning_families.h).
namespace phongpd {

struct RigidSceneFamily {
  std::string name;
  std::string summary;
  std::string key;              // of its one knob, a word
  std::string knob;             // what the number says
  double value = 0.0;           // of the knob, default
  double min = 0.0, max = 0.0;  // of the knob
};

const std::vector<RigidSceneFamily>& RigidSceneFamilies();

struct RigidScene {
  std::string name;  // FAMILY:VALUE
  TriangleMesh robot;
  // They keep apart from each other.
  std::vector<TriangleMesh> obstacles;
  RobotPose start, goal;
  BoundingBox bounds;  // of the robot's origin; part of the problem
  // In the middle of the narrowest place the robot keeps exactly this distance
  // to the obstacles, to rounding, scene's unit: by construction.
  double clearance = 0.0;
  RobotPose narrow;  // the robot there
  // A free path by construction, start and goal included, RigidMotion between
  // the poses.  Empty: none is known by construction.
  std::vector<RobotPose> witness;
};

// By "FAMILY" or "FAMILY:VALUE"; "bugtrap" is an older name of rod_trap. Throws
// InputError for an unknown family and a value that is no number or out of the
// family's range.
RigidScene MakeRigidScene(const std::string& name);

}  // namespace phongpd
