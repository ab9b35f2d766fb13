// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/slice_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace phongpd::bench {
namespace {

bool AreNearlyTheSame(const std::string& a, const std::string& b) {
  char *end_a = nullptr, *end_b = nullptr;
  const double x = std::strtod(a.c_str(), &end_a);
  const double y = std::strtod(b.c_str(), &end_b);
  if (a.empty() || b.empty() || *end_a != '\0' || *end_b != '\0') return false;
  return std::abs(x - y) <=
         kRounding * std::max({1.0, std::abs(x), std::abs(y)});
}

}  // namespace

std::vector<std::size_t> Spread(std::size_t rows, std::size_t count) {
  std::vector<std::size_t> numbers;
  if (rows <= count) {
    for (std::size_t i = 0; i < rows; ++i) numbers.push_back(i);
    return numbers;
  }
  // The middle of each of `count` equal parts.
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back((2 * i + 1) * rows / (2 * count));
  }
  return numbers;
}

void CompareRow(const CsvTable& published, std::size_t row,
                const CsvTable& found, std::size_t again,
                const std::set<std::string>& ignored, const std::string& name,
                Slice* slice) {
  ++slice->remade;
  const std::size_t before = slice->deviations.size();
  bool is_identical = true;
  for (const std::string& column : published.header()) {
    if (ignored.count(column) > 0) continue;
    const std::string& was = published.Text(row, column);
    const std::string& is = found.Text(again, column);
    if (was == is) continue;
    is_identical = false;
    if (AreNearlyTheSame(was, is)) continue;
    slice->deviations.push_back({name, column, was, is});
  }
  if (slice->deviations.size() > before) return;
  (is_identical ? slice->identical : slice->rounded) += 1;
}

}  // namespace phongpd::bench
