// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "problems/scenes/scene.h"

namespace phongpd::testing {

// A scene of a family, and a path that the complete planner found in it.
struct PlannedScene {
  std::string name;  // family and seed
  Scene scene;
  std::vector<Eigen::Vector3d> path;
};
// How many seeds of each family there are: 2; in long campaigns 10.
long PlannedSceneSeeds();
// Of three families, or seven in long campaigns, all seeds that have a path.
std::vector<PlannedScene> PlannedScenes();

}  // namespace phongpd::testing
