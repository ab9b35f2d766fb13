// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/depth.h"
#include "problems/scenes/turning_scene.h"
#include "viewer/view.h"

namespace phongpd {

// The scene's robot and obstacles, start and goal as they are turned.
View TurningSceneView(const TurningScene& scene);

// A way of poses, between which the robot moves by RigidMotion, with as many
// between them as it takes for each to turn by at most 3 degrees.
NamedPath RigidPath(std::string name, const std::vector<RobotPose>& poses,
                    bool is_free);

}  // namespace phongpd
