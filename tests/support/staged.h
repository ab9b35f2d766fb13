// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"

namespace phongpd::testing {

// A scene of a family with its world.
struct Staged {
  explicit Staged(const std::string& family, const WorldLimits& limits = {})
      : scene(SceneSource(family).Load()),
        world(scene.workspace, scene.name, {}, limits) {}

  OptimizeRequest Request(Model model) const {
    OptimizeRequest request = OptimizeRequestOf(scene);
    request.model = model;
    return request;
  }

  Scene scene;
  World world;
};

}  // namespace phongpd::testing
