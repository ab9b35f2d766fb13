// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/bench/contact_space_measure.h"
#include "results/bench/report.h"

namespace phongpd::bench {

struct CaseResult {
  BuildCase build;
  BuildMeasurement all_threads;
  BuildMeasurement one_thread;
  CompetitorMeasurement nef, hulls;  // of cases that compete
};

struct GrowthResult {
  std::string robot;
  std::vector<BuildMeasurement> sizes;
};

// Everything results/contact-space says.
struct ContactSpaceResults {
  std::vector<CaseResult> cases;
  std::vector<GrowthResult> growth;
  std::vector<FuzzCount> fuzz;
  double limit = 0.0;       // seconds, of every process
  double pair_limit = 0.0;  // of a random pair
  std::uint64_t seed = 0;
  int threads = 0;
};

std::vector<NamedTable> ContactSpaceTables(const ContactSpaceResults& results);

// The few columns a terminal has room for.
Table ContactSpaceShortTable(const ContactSpaceResults& results);

// Time and memory over the obstacle's size, log-log.
Figure GrowthFigure(const std::vector<GrowthResult>& growth);

// README.md; `command` is how it was made.
std::string ContactSpaceReadme(const ContactSpaceResults& results,
                               const std::vector<NamedTable>& tables,
                               const std::vector<Figure>& figures,
                               const std::string& command);

// Random pairs that failed, all kinds together.
int FailedPairs(const ContactSpaceResults& results);

}  // namespace phongpd::bench
