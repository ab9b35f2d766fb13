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

// Rows, of which contact_space_report.py makes the pages.
std::vector<NamedTable> ContactSpaceTables(const ContactSpaceResults& results);

// Random pairs that failed, all kinds together.
int FailedPairs(const ContactSpaceResults& results);

}  // namespace phongpd::bench
