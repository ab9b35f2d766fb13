// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/contact/depth.h"

namespace phongpd::cli {

// A depth as one object of JSON, with the keys that `phongpd depth --json`
// documents.
nlohmann::ordered_json DepthAnswerRow(const RobotPose& pose,
                                      const DepthResult& result);

}  // namespace phongpd::cli
