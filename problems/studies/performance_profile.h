// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace phongpd {

// ProfileCurves (trajectory_comparison.h) as an SVG, each curve named at its
// end; Euclidean PD is black, the recommended smoothing length thickest.
// Throws what RenderSvg does.
std::string PerformanceProfile(const std::vector<nlohmann::ordered_json>& rows,
                               const std::string& protocol,
                               const std::string& measure);

}  // namespace phongpd
