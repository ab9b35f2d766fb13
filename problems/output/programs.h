// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd {

// The first of the programs that is on PATH, as a whole path; empty: none.
std::string FindProgram(const std::vector<std::string>& names);

}  // namespace phongpd
