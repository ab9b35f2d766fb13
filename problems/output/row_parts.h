// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "planners/world/length.h"
#include "problems/output/versions.h"

// What rows of results have in common.
namespace phongpd {

inline nlohmann::ordered_json PointRow(const Eigen::Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

// The versions of all that took part, by name.
inline nlohmann::ordered_json VersionsRow() {
  nlohmann::ordered_json row = nlohmann::ordered_json::object();
  for (const auto& [name, version] : Versions()) row[name] = version;
  return row;
}

// A length in a row of results, {"share": of D, "unit": in the user's}; null
// for none.
inline nlohmann::ordered_json LengthRow(
    const std::optional<ResolvedLength>& length) {
  if (!length) return nullptr;
  return {{"share", length->share}, {"unit", length->unit}};
}

// What the user's unit is called; null where it has no name.
inline nlohmann::ordered_json UnitRow(const std::string& unit) {
  if (unit.empty()) return nullptr;
  return unit;
}

}  // namespace phongpd
