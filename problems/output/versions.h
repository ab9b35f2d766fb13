// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace phongpd {

// Name and version of PhongPD, of the libraries it was built with and of the
// compiler, in this order.
std::vector<std::pair<std::string, std::string>> Versions();

}  // namespace phongpd
