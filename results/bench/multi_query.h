// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/bench/report.h"

namespace phongpd::bench {

// Many queries on one scene by one way of answering them.
struct MultiQueryRow {
  std::string scene, planner;
  std::size_t triangles = 0;
  double build_milliseconds = 0.0;  // tables of the planner, or the roadmap
  int nodes = 0, edges = 0;         // 0: of the planner, nothing is lifted
  int lowered_edges = 0, left_out_edges = 0;
  int solved = 0, proved = 0;
  int wrong = 0;          // not free, or another status than the planner's
  int lazy_searches = 0;  // queries handed to the planner
  std::vector<double> milliseconds;
  std::vector<double> lengths, clearances;  // over those of the planner
};

std::vector<std::string> MultiQueryScenes();

// `queries` random pairs of free configurations that do not see each other,
// answered by ContactSurfacePlanner, ContactRoadmap's raw route, and the same
// shortened: a row each.
std::vector<MultiQueryRow> MeasureMultiQuery(const std::string& scene,
                                             int queries, std::uint64_t seed);

Table MultiQueryTable(const std::vector<MultiQueryRow>& rows);

}  // namespace phongpd::bench
