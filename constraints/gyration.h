// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// √(∫ |p|² dA / ∫ dA) over the surfaces together, about the origin, user's
// unit: what a turn of one radian moves them by in the mean.  0 for surfaces
// without area.
double RadiusOfGyration(const std::vector<TriangleMesh>& meshes);

}  // namespace phongpd::internal
