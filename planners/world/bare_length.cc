// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/bare_length.h"

#include <cmath>

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {

Length BareLength(double number, const std::string& unit) {
  // −0 is a zero with a sign that nobody means.
  if (number == 0.0) number = std::abs(number);
  return unit.empty() ? Length::FromShare(number) : Length::FromUnit(number);
}

void RequireClearance(const Length& length, bool is_bare,
                      const std::string& what, double diagonal,
                      const std::string& unit) {
  if (is_bare && length.is_share() && length.value() > kLargestBareShare) {
    const std::string number = FormatDouble(length.value());
    throw InputError(what + ": expected a unit with a number above " +
                     FormatDouble(kLargestBareShare) + ", found " + number +
                     ": did you mean " + number + "unit? or " + number +
                     "D, a share of the world's diagonal D");
  }
  RequireLength(length, LengthRange::kAboveZero, diagonal, what, unit);
}

Length ParseClearance(const std::string& text, const std::string& what,
                      double diagonal, const std::string& unit) {
  const Length length = ParseLength(text, what, unit);
  RequireClearance(length, text.back() != 'D', what, diagonal, unit);
  return length;
}

}  // namespace phongpd
