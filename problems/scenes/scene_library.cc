// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_library.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "problems/scenes/scene_placement.h"
#include "problems/scenes/scene_recipes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::map<std::string, double>;

template <typename Items, typename Name>
std::string Listed(const Items& items, Name name) {
  std::string list;
  for (const auto& item : items) {
    list += (list.empty() ? "" : ", ") + name(item);
  }
  return list;
}

}  // namespace

const std::vector<SceneFamily>& SceneFamilies() {
  static const std::vector<SceneFamily> families = [] {
    std::vector<SceneFamily> list;
    for (const SceneRecipe& recipe : SceneRecipes()) {
      list.push_back(recipe.family);
    }
    return list;
  }();
  return families;
}

Json MakeScene(const std::string& name, const Values& knobs) {
  const std::vector<SceneFamily>& families = SceneFamilies();
  const auto family =
      std::find_if(families.begin(), families.end(),
                   [&](const SceneFamily& f) { return f.name == name; });
  if (family == families.end()) {
    throw InputError(
        "scene: expected one of " +
        Listed(families, [](const SceneFamily& f) { return f.name; }) +
        ", found '" + name + "'");
  }
  std::vector<SceneKnob> known = family->knobs;
  known.insert(known.end(), CommonSceneKnobs().begin(),
               CommonSceneKnobs().end());
  Values values;
  for (const SceneKnob& knob : known) values[knob.key] = knob.value;
  for (const auto& [key, value] : knobs) {
    if (values.count(key) == 0) {
      throw InputError("scene " + name + ": expected one of the knobs " +
                       Listed(known, [](const SceneKnob& k) { return k.key; }) +
                       ", found '" + key + "'");
    }
    values[key] = value;
  }
  const SceneRecipe& recipe =
      SceneRecipes()[static_cast<std::size_t>(family - families.begin())];
  return PlacedScene(recipe, values);
}

}  // namespace phongpd
