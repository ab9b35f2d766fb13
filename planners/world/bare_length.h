// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "planners/world/length.h"

namespace phongpd {

// More than fits nearly anywhere.
inline constexpr double kLargestBareShare = 0.1;

// A clearance or margin as somebody asks for it, ParseLength's and in (0, D]:
// where `diagonal` (D) is 0, lengths in the unit pass that may be too long.  A
// share above kLargestBareShare has to say so, "0.5D": without, it is as a rule
// meant as a length in the unit, as it is where that has a name, `unit`. Throws
// InputError starting with `what`.
Length ParseClearance(const std::string& text, const std::string& what,
                      double diagonal, const std::string& unit = "");

}  // namespace phongpd
