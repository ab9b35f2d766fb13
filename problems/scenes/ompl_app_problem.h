// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "problems/scenes/turning_scene.h"

namespace phongpd {

// Is this the text of a problem of OMPL.app, a .cfg file with a section
// [problem]?
bool IsOmplAppProblem(const std::string& text);

// The rigid body in 3D that such a file, at `path`, tells of: its `robot` and
// `world`, mesh files beside it, `start` and `goal`, and the `volume` that
// bounds the robot's position, if there is one.  As in OMPL.app the robot turns
// about the mean of its vertices, the angle theta is in radians, and scenes
// that name an up axis or a unit are turned and scaled as Assimp does it.  What
// it says of planners and benchmarks is not read.  `root`: as ReadScene.
//
// Throws InputError "FILE: key: expected …, found …": for keys that are missing
// or no numbers, for problems in a plane and of other vehicles, and what
// ReadAnyMesh throws.
TurningScene ParseOmplAppProblem(const std::string& text,
                                 const std::string& path,
                                 const std::string& root = "");

}  // namespace phongpd
