// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "results/bench/jump_classes.h"
#include "results/bench/motion_cases.h"

// How continuous metrics are along motions, and how continuous any rule could
// be.
namespace phongpd::bench {

inline constexpr char kWays[] = "straight, curved";
inline constexpr char kWalks[] = "random walks";

struct ContinuityOptions {
  int motions = 10;  // of each kind, a space
  int frames = 200;
  std::uint64_t seed = 2;
};

// A metric, or the yardstick for some c, on one contact space or all of them.
struct ContinuityRow {
  std::string space, motions, rule;
  int frames = 0;  // inside
  int jumps = 0;
  std::array<int, kJumpClasses> classes = {};  // of metrics
  bool is_bound = false;
  double ratio = 0.0;          // c of a bound
  std::vector<double> ratios;  // of metrics: depth over Euclidean depth

  double Mean() const {
    return is_bound
               ? ratio
               : std::accumulate(ratios.begin(), ratios.end(), 0.0) /
                     std::max<double>(1.0, static_cast<double>(ratios.size()));
  }
};

// Euclid, Phong at some ℓ, the tracker, and the bounds, along motions of either
// kind.
std::vector<ContinuityRow> MeasureContinuity(const MotionSpace& space,
                                             const ContinuityOptions& options);

// The rows of each rule together, the hollow box apart, under those names.
std::vector<ContinuityRow> TotalsOf(const std::vector<ContinuityRow>& rows,
                                    const std::string& space,
                                    const std::string& motions);

}  // namespace phongpd::bench
