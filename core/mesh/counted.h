// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace phongpd {

// "1 triangle", "2 triangles"; for words that form another plural, that too:
// Counted(2, "vertex", "vertices").
template <typename Integer>
std::string Counted(Integer count, const std::string& one,
                    const std::string& many = "") {
  return std::to_string(count) + ' ' +
         (count == Integer{1} ? one : (many.empty() ? one + 's' : many));
}

}  // namespace phongpd
