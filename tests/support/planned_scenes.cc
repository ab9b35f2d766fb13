// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/planned_scenes.h"

#include <cstdint>

#include "planners/solve/plan.h"
#include "problems/scenes/scene_source.h"
#include "tests/support/campaign.h"

namespace phongpd::testing {

long PlannedSceneSeeds() { return CampaignCases(2, 10); }

std::vector<PlannedScene> PlannedScenes() {
  const std::vector<std::string> families =
      IsLongCampaign()
          ? std::vector<std::string>{"u_axis",  "plate",   "tunnel", "hole",
                                     "keyhole", "bugtrap", "clutter"}
          : std::vector<std::string>{"u_axis", "plate", "tunnel"};
  std::vector<PlannedScene> scenes;
  for (const std::string& family : families) {
    for (long seed = 1; seed <= PlannedSceneSeeds(); ++seed) {
      Scene scene = SceneSource(family).Load(static_cast<std::uint64_t>(seed));
      const PathAnswer plan =
          Plan(World(scene.workspace), {scene.start, scene.goal});
      if (!plan.is_solved) continue;
      scenes.push_back(
          {family + ' ' + std::to_string(seed), std::move(scene), plan.path});
    }
  }
  return scenes;
}

}  // namespace phongpd::testing
