// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "viewer/page_numbers.h"
#include "viewer/view.h"

namespace phongpd::internal {

// Adds what lies behind path `number` to the page's lists graphs, planes and
// iterates (view_json.h), and what is left out of them to the notes.
void AddBehind(const NamedPath& path, std::size_t number,
               const PageFrame& frame, nlohmann::ordered_json* page,
               std::vector<std::string>* notes);

}  // namespace phongpd::internal
