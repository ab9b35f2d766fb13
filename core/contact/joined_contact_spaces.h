// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact/contact_space.h"

namespace phongpd {

// The contact space of one robot and several obstacles, put together from the
// contact spaces of each obstacle: one mesh that holds them all, with nothing
// rounded again.  It is C_cont of all obstacles if the solids C_obj share no
// point, which is required and not checked (obstacle_groups.h can tell).  At
// least one space is required; a single one comes back as it is.
//
// The report has the sums of counts and seconds, all warnings, the robot of the
// first, the largest grid step and peak, and is from a cache if all are.  D is
// the diagonal of all together (WithLength gives another).
ContactSpace JoinedContactSpaces(const std::vector<ContactSpace>& spaces);

}  // namespace phongpd
