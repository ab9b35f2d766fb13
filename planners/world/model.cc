// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/model.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"

namespace phongpd {

const std::vector<std::string>& ModelNames() {
  static const std::vector<std::string> names = {"auto", "window", "full"};
  return names;
}

const char* ToString(Model model) {
  return ModelNames()[static_cast<std::size_t>(model)].c_str();
}

Model ParseModel(const std::string& text, const std::string& what) {
  const std::vector<std::string>& names = ModelNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected auto, window or full, found '" + text +
                     "'" + DidYouMean(text, names));
  }
  return static_cast<Model>(found - names.begin());
}

}  // namespace phongpd
