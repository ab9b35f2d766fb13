// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "problems/pictures/viewer/view.h"

namespace phongpd {

// Throws InputError if the program was built without three.js (the Debian
// package libjs-three), which the page is made of.
void RequireViewer();

// One HTML file that shows the view, nothing loaded from elsewhere.  Throws
// like RequireViewer.
std::string ViewPage(const View& view);

}  // namespace phongpd
