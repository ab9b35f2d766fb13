// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace phongpd::internal {

// viewer.html with styles, scripts and three.js in it, and the marks
// @VIEW_TITLE@ and @VIEW_DATA@ in this order; empty if three.js was not there
// when this was built.  Compiled in by embed_page.cmake.
std::string_view PageTemplate();

}  // namespace phongpd::internal
