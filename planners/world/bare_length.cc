// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/bare_length.h"

#include "core/mesh/mesh_error.h"
#include "core/number_text.h"

namespace phongpd {

Length ParseClearance(const std::string& text, const std::string& what,
                      double diagonal, const std::string& unit) {
  const Length length = ParseLength(text, what, unit);
  if (length.is_share() && length.value() > kLargestBareShare &&
      text.back() != 'D') {
    const std::string number = FormatDouble(length.value());
    throw InputError(what + ": expected a unit with a number above " +
                     FormatDouble(kLargestBareShare) + ", found " + number +
                     ": did you mean " + number + "unit? or " + number +
                     "D, a share of the world's diagonal D");
  }
  RequireLength(length, LengthRange::kAboveZero, diagonal, what, unit);
  return length;
}

}  // namespace phongpd
