// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/trajectory/curve_caution.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace phongpd::internal {
namespace {

// Of the gain that was predicted: what a piece may cost, what it is to cost
// after it cost more, and what lets it be trusted more again.
constexpr double kTooMuch = 0.3, kAimedAt = 0.2, kHarmless = 0.015;
constexpr double kTrustedMore = 1.2;
constexpr double kLeastChange = 0.05, kLeastShare = 1e-4;
constexpr double kLeastShareOfHalves = 0.1;
constexpr double kFew = 0.25;  // of the pieces

}  // namespace

bool CurveCaution::Learn(const std::vector<double>& slowings,
                         double predicted) {
  shares_.resize(slowings.size(), 1.0);
  std::size_t blamed = 0;
  for (std::size_t i = 0; i < slowings.size(); ++i) {
    const double cost = (slowings[i] - 1.0) / predicted;
    if (cost > kTooMuch) {
      ++blamed;
      shares_[i] = std::max(
          kLeastShare, std::max(kLeastChange, kAimedAt / cost) * shares_[i]);
    } else if (cost < kHarmless) {
      shares_[i] = std::min(1.0, kTrustedMore * shares_[i]);
    }
  }
  return blamed > 0 && static_cast<double>(blamed) <=
                           kFew * static_cast<double>(slowings.size());
}

void CurveCaution::Halve() {
  std::vector<double> halves;
  for (const double share : shares_) {
    halves.insert(halves.end(), 2, std::max(share, kLeastShareOfHalves));
  }
  shares_ = std::move(halves);
}

}  // namespace phongpd::internal
