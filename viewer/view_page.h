// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "viewer/display_mesh.h"
#include "viewer/view.h"

namespace phongpd {

// Throws InputError if the program was built without three.js (the Debian
// package libjs-three), which the page is made of.
void RequireViewer();

// One HTML file that shows the view, nothing loaded from elsewhere; meshes with
// more than `most_triangles` together are drawn coarser, and it says so. Throws
// like RequireViewer.
std::string ViewPage(const View& view,
                     std::size_t most_triangles = kMaxDisplayTriangles);

}  // namespace phongpd
