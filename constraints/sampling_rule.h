// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace phongpd {

// No more interior samples in a segment, whatever the rule says.
inline constexpr int kMaxSamplesPerSegment = 1000;
// How long a segment may be, as a multiple of those of the straight line, where
// nobody says: room for a way around.
inline constexpr double kMaxSegmentRatio = 1.6;

// The rule of samples, for all who make rows of a path: the least S with
//
//   S + 1 > h/(2·margin),
//
// so that a segment of length ≤ h meets no obstacle where its ends and S
// interior points at equal distances keep the margin, d being 1-Lipschitz.  At
// most kMaxSamplesPerSegment, where the certificate is lost; 0 for a margin of
// 0, for which no number would do.
inline int SamplesByRule(double h, double margin) {
  if (!(margin > 0.0)) return 0;
  return static_cast<int>(std::min(std::floor(h / (2.0 * margin)),
                                   static_cast<double>(kMaxSamplesPerSegment)));
}

}  // namespace phongpd
