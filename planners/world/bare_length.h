// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "planners/world/length.h"

namespace phongpd {

// More than fits nearly anywhere.
inline constexpr double kLargestBareShare = 0.1;

// A number ≥ 0 that says no more: in the user's unit if that has a name,
// `unit`, else a share of D.  What ParseLength makes of such a text.
Length BareLength(double number, const std::string& unit);

// Throws InputError starting with `what` unless a clearance or margin is in
// (0, D]; where `diagonal` (D) is 0, lengths in the unit pass that may be too
// long.  `is_bare`: it was asked for by a number alone.  Then a share is at
// most kLargestBareShare; a larger one is as a rule meant as a length in the
// unit.
void RequireClearance(const Length& length, bool is_bare,
                      const std::string& what, double diagonal,
                      const std::string& unit = "");

// ParseLength and RequireClearance; a share above kLargestBareShare has to say
// so, "0.5D".
Length ParseClearance(const std::string& text, const std::string& what,
                      double diagonal, const std::string& unit = "");

}  // namespace phongpd
