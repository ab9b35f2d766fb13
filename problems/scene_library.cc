// SPDX-License-Identifier: GPL-3.0-or-later
#include "problems/scene_library.h"

#include <nlohmann/json.hpp>

#include "problems/scene_recipes.h"

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
    for (const SceneRecipe& recipe : SceneRecipes())
      list.push_back(recipe.family);
    return list;
  }();
  return families;
}

Json MakeScene(const std::string& name, const Values& knobs) {
  const SceneRecipe* recipe = nullptr;
  for (const SceneRecipe& candidate : SceneRecipes()) {
    if (candidate.family.name == name) recipe = &candidate;
  }
  if (recipe == nullptr) {
    throw InputError(
        "scene: expected one of " +
        Listed(SceneRecipes(),
               [](const SceneRecipe& r) { return r.family.name; }) +
        ", found '" + name + "'");
  }
  Values values;
  for (const SceneKnob& knob : recipe->family.knobs) {
    values[knob.key] = knob.value;
  }
  for (const auto& [key, value] : knobs) {
    if (values.count(key) == 0) {
      throw InputError("scene " + name + ": expected one of the knobs " +
                       Listed(recipe->family.knobs,
                              [](const SceneKnob& k) { return k.key; }) +
                       ", found '" + key + "'");
    }
    values[key] = value;
  }
  const SceneLayout layout = recipe->make(values);
  const double r = layout.reach;
  return {
      {"name", name},
      {"robot", {{"shape", layout.robot}}},
      {"obstacles", Json::array({{{"id", "obstacle"},
                                  {"shape", layout.obstacle},
                                  {"position", layout.position}}})},
      {"bounds", {{"min", {-r, -r, -r}}, {"max", {r, r, r}}}},
      {"start", layout.start},
      {"goal", layout.goal},
      {"penetration",
       {{"metric", "phong"},
        {"field", "normal"},
        {"smoothing_length", 0.1},
        {"jacobian", "direction"}}},
  };
}

}  // namespace phongpd
