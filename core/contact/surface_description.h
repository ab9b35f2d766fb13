// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/contact_space_report.h"

namespace phongpd::internal {

// Fills in what can be said of a finished contact mesh by looking at it:
// counts, topology, volume, quality, and warnings of what rounding did.
// Closed and edge-manifold.
void DescribeSurface(const TriangleMesh& mesh, ContactSpaceReport* report);

}  // namespace phongpd::internal
