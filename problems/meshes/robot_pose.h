// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "problems/meshes/robot_file.h"

namespace phongpd {

// The collision shapes of all links of a URDF file, as one mesh in the frame of
// the root link, metres, with its joints at the values that `text` gives,
// "JOINT=VALUE,JOINT=VALUE": radians, or metres of prismatic joints.  Joints
// that it does not name are at 0.
//
// A child link's frame is that of its joint, which is
//   T_parent · T_origin · (rotation about, or translation along, the axis);
// a joint that mimics another one has multiplier · value + offset.  What a
// shape is, and where its mesh file may lie: ReadAnyMesh.
//
// Throws InputError, one line with the file's name: SDF; joints that are named
// but not there, fixed or mimicking; values outside a joint's limits, 0 too;
// floating and planar joints; links that are no one tree.
TriangleMesh PoseRobot(RobotFile* robot, const std::string& text,
                       std::vector<std::string>* warnings);

}  // namespace phongpd
