// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/view.h"

// Answers out of the JSON that commands wrote, to look at.  They throw
// nlohmann::json::exception for what is none.
namespace phongpd::cli {

ViewAnswer DepthAnswerOf(const nlohmann::ordered_json& row);  // of depth
ViewAnswer QueryAnswerOf(const nlohmann::ordered_json& row);  // of query

}  // namespace phongpd::cli
