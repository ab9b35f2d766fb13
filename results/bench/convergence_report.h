// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "problems/studies/trajectory_comparison.h"
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
  std::vector<std::string> families;  // labels without their knobs
  bool is_scanned = false;            // obstacles with a knob `edge`
};
const std::vector<SceneGroup>& SceneGroups();
bool Belongs(const std::string& scene, const SceneGroup& group);

struct ConvergenceResults {
  std::vector<nlohmann::ordered_json> rows;
  std::vector<ComparisonCell> cells;
  std::vector<DepthExcess> excess;
};

// The metric that is compared with Euclidean PD.
inline constexpr char kPreset[] = "phong@0.2";
// Null if there were no such runs.
const ComparisonCell* Find(const std::vector<ComparisonCell>& cells,
                           const std::string& scene,
                           const std::string& protocol,
                           const std::string& method);
// Solved / runs, and what the tables explain.
std::string SolvedText(const ComparisonCell& cell);

// PhongPD against Euclidean PD, seed by seed, and what lies behind losses
// (convergence_verdicts.cc).
Table VerdictTable(const ConvergenceResults& results);
// The study's own metrics (problems/studies/study_metrics.h) against both.
Table WhatHelpsTable(const ConvergenceResults& results);
// PhongPD against Euclidean PD over all scenes, a line for each protocol.
std::string DuelLines(const ConvergenceResults& results);
Table LossTable(const ConvergenceResults& results);

std::vector<NamedTable> Tables(const ConvergenceResults& results);
// ℓ against depth, share solved and iterations: of cells and excess alone.
std::vector<Figure> TradeOffFigures(const ConvergenceResults& results);
std::vector<Figure> Figures(const ConvergenceResults& results);
// Targets met and missed, then those duels: the text above the tables
// (convergence_findings.cc).
std::string WonAndLost(const ConvergenceResults& results);
std::string Findings(const ConvergenceResults& results);

}  // namespace phongpd::bench
