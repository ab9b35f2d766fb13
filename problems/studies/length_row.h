// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "problems/world/length.h"

namespace phongpd {

// A length in a row of results, {"share": of D, "unit": in the user's}; null
// for none.
inline nlohmann::ordered_json LengthRow(
    const std::optional<ResolvedLength>& length) {
  if (!length) return nullptr;
  return {{"share", length->share}, {"unit", length->unit}};
}

}  // namespace phongpd
