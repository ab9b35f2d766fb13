// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/contact/depth.h"

namespace phongpd::cli {

// A depth as one object of JSON, with the keys that `phongpd depth --json`
// documents.
nlohmann::ordered_json DepthAnswerRow(const RobotPose& pose,
                                      const DepthResult& result);

// For people: numbers of a sentence have so many digits, rows keep all.
inline constexpr int kDigits = 6;
std::string RoundedPoint(const Eigen::Vector3d& point);

}  // namespace phongpd::cli
