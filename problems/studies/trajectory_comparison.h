// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planners/trajectory/trajectory_pipeline.h"
#include "problems/studies/comparison_rows.h"

namespace phongpd {

// One way of running the optimiser, the same for every metric.
struct TrajectoryProtocol {
  std::string name;
  std::string meaning;
  PipelineOptions options;
};

// straight-monotone, straight-adaptive, repaired-monotone, repaired-adaptive:
// one solve by Ipopt; pipeline: what `optimize` does by default.
const std::vector<TrajectoryProtocol>& TrajectoryProtocols();
// Throws InputError for an unknown name.
const TrajectoryProtocol& FindProtocol(const std::string& name);

// All runs of one scene, protocol and metric.
struct ComparisonCell {
  std::string scene, protocol, method;
  int runs = 0;
  int solved = 0;       // claimed by the solver or the pipeline, and free
  int stalled = 0;      // of them, by a stall stop: free, not proved optimal
  int free_only = 0;    // exactly free, but not solved
  int claims_only = 0;  // "solved" but collides
  double median_iterations = 0.0;  // of an even number: between the two
  double restoration_share = 0.0;  // of all iterations
  double median_seconds = 0.0;     // without the contact space
  double callback_share = 0.0;     // of the seconds
  int rivals = 0;  // solved runs on seeds where something was solved
  // Objective over the best found by anything on that seed that keeps as clear
  // (missing_clearance not above its own or 0.1), of solved runs; 1 where the
  // best is 0.
  double mean_ratio = 0.0;
  int within_2_percent = 0, within_10_percent = 0;
  double least_clearance = 0.0;  // share of D, of solved runs
};

// Cells in order of first appearance.  Rows as TrajectoryRow writes them with
// the key `protocol`; throws InputError like CheckComparisonRow, naming the
// row.
std::vector<ComparisonCell> Summarize(
    const std::vector<nlohmann::ordered_json>& rows);
std::string ComparisonCsv(const std::vector<ComparisonCell>& cells);

// Dolan–Moré performance profile over all (scene, seed) of one protocol: the
// share of problems that a method solves within a factor of the best one.
struct ProfileCurve {
  std::string method;
  std::vector<double> ratios;  // measure over the least of all methods, of the
                               // problems it solved; ascending
  int problems = 0;            // that it was asked, solved by it or not

  // In [0, 1].
  double Share(double factor) const;
};
// `measure`: "iterations", "evaluations/jacobian" or "seconds/total".  Methods
// in order of first appearance.
std::vector<ProfileCurve> ProfileCurves(
    const std::vector<nlohmann::ordered_json>& rows,
    const std::string& protocol, const std::string& measure);

}  // namespace phongpd
