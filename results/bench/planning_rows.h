// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "results/bench/multi_query.h"
#include "results/bench/planning_measure.h"
#include "results/bench/report.h"

namespace phongpd::bench {

struct PlanningResults {
  PlanningOptions options;
  std::vector<ExactRow> exact;
  std::vector<SamplerRow> samplers;   // SamplerProblems
  std::vector<SamplerRow> narrowing;  // NarrowingProblems
  std::vector<MotionRow> motions;
  std::vector<MultiQueryRow> multi_query;
};

// The rows of results/planning; planning_report.py makes its pages of them.
Table ExactTable(const PlanningResults& results);
Table MotionTable(const PlanningResults& results);
// Every run of the samplers.
std::string RunsCsv(const PlanningResults& results);

}  // namespace phongpd::bench
