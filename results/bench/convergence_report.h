// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "problems/trajectory_comparison.h"
#include "results/bench/report.h"

namespace phongpd::bench {

// What smoothing costs in depth: PhongPD over Euclidean PD at interior points.
struct DepthExcess {
  std::string scene;
  double smoothing_length = 0.0;  // fraction of D
  double mean = 1.0;
  double worst = 1.0;
  double limited_share = 0.0;  // vertices the limiter turned
  // Angle between the Jacobian `direction` and the exact gradient, degrees.
  double median_angle = 0.0;
  double worst_angle = 0.0;
};

// Scene labels by what kind of trouble they are.
struct SceneGroup {
  std::string name;
  std::vector<std::string> scenes;  // labels begin with one of these
};
const std::vector<SceneGroup>& SceneGroups();

struct ConvergenceResults {
  std::vector<nlohmann::ordered_json> rows;
  std::vector<ComparisonCell> cells;
  std::vector<DepthExcess> excess;
};

std::vector<NamedTable> Tables(const ConvergenceResults& results);
std::vector<Figure> Figures(const ConvergenceResults& results);
// Targets met and missed, wins, ties and losses: the text above the tables.
std::string Findings(const ConvergenceResults& results);

}  // namespace phongpd::bench
