// SPDX-License-Identifier: GPL-3.0-or-later
#include <nlohmann/json.hpp>
#include <string>

#include "problems/scenes/fleet_scene.h"
#include "problems/scenes/json_schema.h"
#include "problems/scenes/scene.h"
#include "tests/fuzz/fuzz_targets.h"
#include "tests/fuzz/promise.h"

namespace phongpd::fuzz {
namespace {

using Json = nlohmann::ordered_json;

// Cuts what makes shapes of very many triangles, which are right but slow.
void CutCounts(Json* value) {
  if (value->is_array()) {
    for (Json& item : *value) CutCounts(&item);
  }
  if (!value->is_object()) return;
  for (const auto& [key, item] : value->items()) {
    CutCounts(&item);
    if (!item.is_number()) continue;
    for (const char* name :
         {"around", "across", "sides", "meridians", "parallels"}) {
      if (key == name && item.get<double>() > 12) item = 12;
    }
    if (key == "triangles" && item.get<double>() > 80) item = 80;
  }
  if (value->contains("of")) value->erase("of");
}

}  // namespace

void Scene(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    Json json = ParseJson(text, "fuzz");
    CutCounts(&json);
    // A root that does not exist: mesh files are refused.
    if (HasRobots(json)) {
      const auto fleet =
          ParseFleetScene(json, "fuzz", ".", "scene", "fuzz-no-root");
      Promise(!fleet.robots.empty(), "a scene of several has robots");
      for (const auto& scene : fleet.robots) {
        Promise(!scene.workspace.robot.IsEmpty(), "each robot has a solid");
        Promise(scene.start.allFinite() && scene.goal.allFinite(),
                "each start and goal is finite");
      }
      return;
    }
    const auto scene = ParseScene(json, "fuzz", ".", "scene", "fuzz-no-root");
    Promise(!scene.workspace.robot.IsEmpty(), "a scene has a robot");
    Promise(!scene.workspace.obstacles.empty(), "a scene has obstacles");
    Promise(scene.start.allFinite() && scene.goal.allFinite(),
            "start and goal are finite");
  } catch (const InputError& error) {
    PromiseReadable(error, "fuzz");
  }
}

}  // namespace phongpd::fuzz
