// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact/robot_pose.h"
#include "problems/scenes/turning_scene.h"
#include "viewer/view.h"

namespace phongpd {

// The scene's robot and obstacles, start and goal as they are turned.
View TurningSceneView(const TurningScene& scene);

// The way through DrawnPoses of these.
NamedPath RigidPath(std::string name, const std::vector<RobotPose>& poses,
                    bool is_free);

}  // namespace phongpd
