// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "planners/world/world.h"
#include "problems/scenes/scene.h"

namespace phongpd {

// The world of one scene after the other: kept, with all that is built in it,
// while only start, goal and settings change, as they do from seed to seed of a
// family.
class KeptWorld {
 public:
  explicit KeptWorld(const ContactSpaceCache& cache = {},
                     const WorldLimits& limits = {})
      : cache_(cache), limits_(limits) {}

  // Builds nothing.  Throws what World throws.
  const World& Of(const Scene& scene) {
    if (!world_ || !HaveSameSolids(scene.workspace, world_->workspace())) {
      world_.emplace(scene.workspace, scene.name, cache_, limits_);
    }
    return *world_;
  }

 private:
  ContactSpaceCache cache_;
  WorldLimits limits_;
  std::optional<World> world_;
};

}  // namespace phongpd
