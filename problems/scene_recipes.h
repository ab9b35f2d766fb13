// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "problems/scene_library.h"

namespace phongpd {

// What differs from scene to scene; everything else is common.
struct SceneLayout {
  nlohmann::ordered_json robot;  // shape objects, see scene_shapes.h
  nlohmann::ordered_json obstacle;
  std::array<double, 3> position = {0.0, 0.0, 0.0};  // of the obstacle
  double reach = 0.0;  // half-width of the cubic bounds
  std::array<double, 3> start;
  std::array<double, 3> goal;
};

// A family and how its knobs become a layout.
struct SceneRecipe {
  SceneFamily family;
  SceneLayout (*make)(std::map<std::string, double>& knobs);
};

const std::vector<SceneRecipe>& SceneRecipes();

}  // namespace phongpd
