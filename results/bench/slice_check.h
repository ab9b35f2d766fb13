// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "results/bench/csv_table.h"

// Published rows beside the same rows made anew.
namespace phongpd::bench {

// A cell that came out otherwise.
struct Deviation {
  std::string row, column, published, found;
};

// Some rows of one published file.
struct Slice {
  std::string file;      // below results/
  std::string compared;  // which columns, in words
  std::size_t published = 0;
  std::size_t remade = 0;
  std::size_t identical = 0;  // of these, in all columns compared
  std::size_t rounded = 0;    // others, but for rounding
  std::vector<Deviation> deviations;
};

// The numbers of `count` rows spread evenly over `rows`; all where there are
// not more.
std::vector<std::size_t> Spread(std::size_t rows, std::size_t count);

// Notes the cells in which row `row` of `published` and row `again` of `found`
// differ, columns of `ignored` apart: as texts, and as numbers by more than
// kRounding times the larger one or one.  Throws InputError where `found` lacks
// a column.
inline constexpr double kRounding = 1e-12;
void CompareRow(const CsvTable& published, std::size_t row,
                const CsvTable& found, std::size_t again,
                const std::set<std::string>& ignored, const std::string& name,
                Slice* slice);

}  // namespace phongpd::bench
