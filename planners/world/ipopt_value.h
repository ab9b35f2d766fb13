// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>

namespace phongpd {

// The value of one of Ipopt's own options: a whole number, a real number, or
// one of its words, such as "adaptive".  A whole number may stand for a real
// one, and "1e-6" for the number.  (Ipopt 3.11 itself keeps six digits.)
using IpoptValue = std::variant<int, double, std::string>;

// Options by Ipopt's own names.
using IpoptValues = std::map<std::string, IpoptValue>;

}  // namespace phongpd
