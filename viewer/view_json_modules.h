// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/view.h"

// A page's WebAssembly, with what it works on (view_json.h has the form).
namespace phongpd::internal {

// What the page needs for its probe; null without contact spaces, where they
// are shown in part or too large, or where the probe was not built.
nlohmann::ordered_json ProbeJson(const View& view,
                                 std::vector<std::string>* notes);

// What the page needs to plan by itself from a start to a goal that it has;
// null where it is served, for several robots or among obstacles that move, for
// meshes that are too large, and where the solver was not built.
nlohmann::ordered_json SolverJson(const View& view);

}  // namespace phongpd::internal
