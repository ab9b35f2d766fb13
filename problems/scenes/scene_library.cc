// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scenes/scene_library.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "problems/output/text.h"
#include "problems/scenes/scene_placement.h"
#include "problems/scenes/scene_recipes.h"

namespace phongpd {
namespace {

using Json = nlohmann::ordered_json;
using Values = std::map<std::string, double>;

template <typename Items, typename Name>
std::vector<std::string> NamesOf(const Items& items, Name name) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(name(item));
  return names;
}

[[noreturn]] void FailUnknown(const std::string& what,
                              const std::vector<std::string>& names,
                              const std::string& found) {
  throw InputError(what + Joined(names) + "; found '" + found + "'" +
                   DidYouMean(found, names));
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
    FailUnknown("scene: expected one of ",
                NamesOf(families, [](const SceneFamily& f) { return f.name; }),
                name);
  }
  std::vector<SceneKnob> known = family->knobs;
  known.insert(known.end(), CommonSceneKnobs().begin(),
               CommonSceneKnobs().end());
  Values values;
  for (const SceneKnob& knob : known) values[knob.key] = knob.value;
  for (const auto& [key, value] : knobs) {
    if (values.count(key) == 0) {
      FailUnknown("scene " + name + ": expected one of the knobs ",
                  NamesOf(known, [](const SceneKnob& k) { return k.key; }),
                  key);
    }
    values[key] = value;
  }
  const SceneRecipe& recipe =
      SceneRecipes()[static_cast<std::size_t>(family - families.begin())];
  return PlacedScene(recipe, values);
}

}  // namespace phongpd
