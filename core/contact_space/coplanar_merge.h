// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact_space/plane_groups.h"
#include "core/contact_space/surface_assembly.h"

namespace phongpd::internal {

// Joins edge-connected triangles of one plane into patches, drops patch
// border vertices that are exactly collinear between two patches, and
// triangulates every patch anew (constrained Delaunay).  The surface stays the
// same point set.  A patch that cannot be rebuilt keeps its triangles.
// Removes most slivers: 20,174 → 900 triangles for two aligned wrenches.
ExactSurface MergeCoplanar(const ExactSurface& surface,
                           const Convolution& convolution,
                           const PlaneGroups& groups,
                           const ExactPoints& points);

}  // namespace phongpd::internal
