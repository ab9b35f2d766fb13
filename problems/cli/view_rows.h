// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/contact/depth.h"
#include "viewer/view.h"

namespace phongpd::cli {

// An answer to look at.
ViewAnswer ViewAnswerOf(const RobotPose& pose, const Depth& depth);

// The same out of the JSON that commands wrote.  They throw
// nlohmann::json::exception for what is none.
ViewAnswer DepthAnswerOf(const nlohmann::ordered_json& row);  // of depth
ViewAnswer QueryAnswerOf(const nlohmann::ordered_json& row);  // of query

}  // namespace phongpd::cli
