// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/preset.h"

#include <algorithm>

#include "core/mesh/mesh_error.h"
#include "core/nearest_name.h"
#include "core/number_text.h"

namespace phongpd {

const std::vector<std::string>& PresetNames() {
  static const std::vector<std::string> names = {"fast", "balanced", "tight"};
  return names;
}

const char* ToString(Preset preset) {
  return PresetNames()[static_cast<std::size_t>(preset)].c_str();
}

Preset ParsePreset(const std::string& text, const std::string& what) {
  const std::vector<std::string>& names = PresetNames();
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) {
    throw InputError(what + ": expected one of " + Joined(names) + ", found '" +
                     text + "'" + DidYouMean(text, names));
  }
  return static_cast<Preset>(found - names.begin());
}

}  // namespace phongpd
