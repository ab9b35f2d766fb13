// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/view.h"

namespace phongpd {

// Seconds of an animation, whatever the way is long.
inline constexpr double kGltfSeconds = 8.0;

// The view as binary glTF 2.0 (GLB): meshes with materials, obstacles opaque,
// contact spaces translucent; every path as a line; and the robot, whose node
// has an animation for each path (by length), for the motion (by frames) and
// for poses with answers (in steps).  A root node turns z up into glTF's y up,
// and a node below it moves the picture's centre to the origin of the vertices,
// which glTF keeps in single precision.  Meshes are whole, however large.
// Throws InputError where that precision cannot hold the view's place or size.
std::string ViewGlb(const View& view);

}  // namespace phongpd
