// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace phongpd {

// No more interior samples in a segment, whatever the rule says.
inline constexpr int kMaxSamplesPerSegment = 1000;
// By default a segment may be so many times as long as one of the straight
// line: room for a way around.
inline constexpr double kMaxSegmentRatio = 1.6;

// How many samples a segment needs, for all who make rows of a path: the least
// S with
//
//   S + 1 > h/(2·margin).
//
// d is 1-Lipschitz.  So a segment of length ≤ h meets no obstacle if its ends,
// and S interior points at equal distances, keep the margin.  At most
// kMaxSamplesPerSegment, for which this need not hold any more; 0 for a margin
// of 0, for which no number would be enough.
inline int SamplesByRule(double h, double margin) {
  if (!(margin > 0.0)) return 0;
  return static_cast<int>(std::min(std::floor(h / (2.0 * margin)),
                                   static_cast<double>(kMaxSamplesPerSegment)));
}

}  // namespace phongpd
