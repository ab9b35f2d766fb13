// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/mesh/mesh_error.h"

// Procedural scenes, each with knobs: sizes in the scene's unit and counts.
namespace phongpd {

struct SceneKnob {
  std::string key;
  double value = 0.0;  // default
  std::string meaning;
};

struct SceneFamily {
  std::string name;
  std::string summary;
  std::vector<SceneKnob> knobs;
};

// All families, the paper's three first.
const std::vector<SceneFamily>& SceneFamilies();

// The knobs that every family has besides its own: seed, rotation_seed, offset
// and scale.
const std::vector<SceneKnob>& CommonSceneKnobs();

// The scene file's content for the family `name` with some knobs set: solids
// as `shape` objects, free start and goal, and where the family knows them a
// witness path that is free by construction, and whether one exists.  Throws
// InputError for an unknown family or knob and for sizes that give no solid.
nlohmann::ordered_json MakeScene(const std::string& name,
                                 const std::map<std::string, double>& knobs);

}  // namespace phongpd
