// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "viewer/view.h"

namespace phongpd {

// A still picture of lines, seen obliquely from above: the sharp edges of the
// view's contact spaces (facets turn by more than 20°; all edges where none is
// sharp) and its paths; those that collide are dashed.
std::string PathSvg(const View& view);

}  // namespace phongpd
