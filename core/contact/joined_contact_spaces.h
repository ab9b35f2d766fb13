// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/contact/contact_space.h"

namespace phongpd {

// The contact space of one robot and several obstacles from those of each, one
// after the other in one mesh.  That is C_cont of all of them where the solids
// C_obj share no point, which is required and not checked (obstacle_groups.h
// tells); nothing is rounded again.  At least one.
//
// The report has the sums of their counts, seconds and warnings, the first
// one's robot, the largest grid step and peak, and is from a cache where all
// are.  A single space comes back as it is; D of others is the diagonal of all
// together (WithLength gives another).
ContactSpace JoinedContactSpaces(const std::vector<ContactSpace>& spaces);

}  // namespace phongpd
