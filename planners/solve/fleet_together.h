// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "planners/solve/fleet.h"

namespace phongpd::internal {

// The motions of a solved answer, made faster together (HastenTogether), all of
// one duration; its pairs are to be judged.  `wanted`: as good as can be
// expected, s.  None: they were not made faster.
std::optional<FleetAnswer> Hastened(const std::vector<FleetRobot>& robots,
                                    const FleetAnswer& answer, double wanted);

// The same from motions that all turn the same way (joint_turns.h), whatever
// the answer's were: who passes on which side of whom is another.  None: these
// are not free of each other or of what is fixed, or there are obstacles that
// move by themselves or places on the way.
std::optional<FleetAnswer> HastenedInTurns(
    const std::vector<FleetRobot>& robots, const FleetAnswer& answer,
    double wanted);

}  // namespace phongpd::internal
