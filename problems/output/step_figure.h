// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace phongpd {

// A curve that rises in steps: at points[i].first to points[i].second, both
// from small to large, the former > 0.
struct StepCurve {
  // Thick blue; dashed black; told apart for colour-blind readers, by dash once
  // more.
  enum class Role { kMain, kBaseline, kOther };

  std::string name;  // at its end
  Role role = Role::kOther;
  std::vector<std::pair<double, double>> points;
};

// What surrounds them.
struct StepFrame {
  std::string title, x, y;         // as they stand
  double least = 1.0, most = 1e2;  // of x, which is logarithmic; y: 0 to 1
};

// The curves as an SVG, each named at its end: the highest on top, of equals
// the first to rise.  Throws what RenderSvg does.
std::string StepFigure(const std::vector<StepCurve>& curves,
                       const StepFrame& frame);

}  // namespace phongpd
