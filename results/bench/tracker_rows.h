// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/bench/report.h"

// Rows of tracker_benchmark, of which tracker_report.py makes tracker.md.
namespace phongpd::bench {

// One metric over one contact space, or over all.
struct TrackerRow {
  std::string space, metric;
  std::size_t triangles = 0;
  int frames = 0;   // inside
  int jumps = 0;    // of more than 5 % of the diagonal
  int beyond = 0;   // changes beyond (κ + 1)·|Δq|, exits elsewhere apart
  int exits = 0;    // elsewhere
  int sliding = 0;  // frames
  std::vector<double> ratios;
  std::vector<double> micros;  // of inside frames: the least of the repeats

  double MeanRatio() const;
  double AboveThree() const;  // per cent of the frames
};

NamedTable TrackerTable(const std::vector<TrackerRow>& rows);

// All spaces but the hard one together, a row a metric.
NamedTable TrackerTotals(const std::vector<TrackerRow>& rows);

}  // namespace phongpd::bench
