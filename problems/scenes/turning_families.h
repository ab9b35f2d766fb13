// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "problems/scenes/scene_library.h"

// The procedural scenes of a robot that turns (rigid_scenes.h) as commands take
// scenes: "alpha:gap=1.2", or "alpha:1.2", as each has one knob.
namespace phongpd {

// None has the name of one of SceneFamilies(), nor their common knobs.
const std::vector<SceneFamily>& TurningSceneFamilies();

bool IsTurningFamily(const std::string& name);

// The scene file's content, as ParseTurningScene takes it; solids as `shape`
// objects.  Throws InputError for an unknown family or knob and for values out
// of range.
nlohmann::ordered_json MakeTurningScene(
    const std::string& name, const std::map<std::string, double>& knobs);

// The names of all families there are, SceneFamilies() first.
std::vector<std::string> SceneFamilyNames();

}  // namespace phongpd
