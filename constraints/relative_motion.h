// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/trajectory.h"

namespace phongpd {

// A motion as somebody sees it who moves along another one.
struct RelativeMotion {
  Trajectory curve;
  // The exact difference, at any time, is no farther from the curve.
  double rounding = 0.0;
};

// The difference of two motions, each at rest before it begins and after it
// ends,
//
//   d(t) = a(t) − b(t + b_time),   t ∈ [0, until]:
//
// by pieces between the knots of both, each of the larger of their degrees.  A
// body that follows a touches one that follows b at the time t exactly if the
// first, moved by d(t), touches the second where that is at rest at 0; so what
// keeps d free of their contact space (curve_judge.h, with `rounding` as its
// blur) keeps the bodies apart.
//
// The rounding: of splits, 2n ulps of the largest coordinate; of degrees and
// differences; and what the bodies move by while knots are off, by the rounding
// of times, or joined, because they are no more than 2⁻⁴⁸ of all that time
// apart.
//
// Throws InputError for motions that are empty, `until` not above 0 and times
// that are not finite.
RelativeMotion RelativeMotionOf(const Trajectory& a, const Trajectory& b,
                                double until, double b_time = 0.0);

}  // namespace phongpd
