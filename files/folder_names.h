// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace phongpd::internal {

// The names in a folder, but for . and .., in no order; none where it cannot be
// read.  Throws std::bad_alloc, where std::filesystem's iterators end the
// program.
std::vector<std::string> NamesIn(const std::string& folder);

}  // namespace phongpd::internal
