// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "planners/solve/removal.h"

namespace phongpd::internal {

// A way out of a part that no translation takes out: status, reason, poses,
// pivot and length of *removal; the rest stays as it is.  `part` as it moves,
// perhaps drawn in.  It ends where its box is beside that of the rest.
void RemoveByTurning(const Solid& part, const std::vector<Solid>& rest,
                     double seconds, Removal* removal);

}  // namespace phongpd::internal
