// SPDX-License-Identifier: GPL-3.0-or-later
#include "results/bench/paired_test.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace phongpd::bench {

double SignTest(int wins, int losses) {
  const int n = wins + losses;
  double tail = 0.0;
  for (int k = 0; k <= std::min(wins, losses); ++k) {
    tail += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) -
                     std::lgamma(n - k + 1.0) - n * std::log(2.0));
  }
  return std::min(1.0, 2.0 * tail);
}

std::vector<double> Holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double least = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double factor = static_cast<double>(p.size() - i);
    least = std::min(1.0, std::max(least, factor * p[order[i]]));
    adjusted[order[i]] = least;
  }
  return adjusted;
}

}  // namespace phongpd::bench
