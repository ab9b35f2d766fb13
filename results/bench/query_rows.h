// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/bench/report.h"

// Rows of query_benchmark, of which query_report.py makes the pages.
namespace phongpd::bench {

// One kind of query on one sequence of points in one contact space.
struct QueryRow {
  std::string space;
  std::size_t triangles = 0;
  std::string sequence;  // "random", or "step 0.001": a share of D
  std::string query;     // "cold@0.2": smoothing length 0.2
  double micros = 0.0;   // a query: median of the repetitions
};

// What is no time of one query.
struct QueryExtras {
  std::string batch_space;
  double batch_speedup = 0.0;  // 2 threads over 1
  std::string process_space;
  double process_seconds = 0.0;  // phongpd query of 10⁴ points
  // Bytes a triangle of a contact space with its tree and a metric, ℓ = 0; the
  // most there are.
  double most_bytes = 0.0;
  std::string most_bytes_space;
};

NamedTable QueryTable(const std::vector<QueryRow>& rows);

NamedTable ExtrasTable(const QueryExtras& extras);

}  // namespace phongpd::bench
