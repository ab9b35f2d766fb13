// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/contact_space/contact_space.h"

namespace phongpd::internal {

// Refines the triangulation of a closed, edge-manifold contact space to
// `options` (target_edge > 0) and leaves the surface as it is: Delaunay
// refinement (Ruppert 1995) inside the planar patches, whose borders are split
// in both patches at once.  A triangle is refined
//  - when one of its edges is longer than h (edge_length_field.h) at its
//    middle: afterwards none is;
//  - when its circumradius is more than √2 × its shortest edge (an angle below
//    20.7°), unless that angle is between two patch borders or the new vertex
//    would be closer than h/4 to others.  That bound makes it end, so slivers
//    thinner than about h/4 stay, cut to length.
// Triangles without area after rounding to double stay as they are, with their
// edges.
//
// Guarantees (patch_mesh.h): closed and manifold stay so; no triangle loses
// its area or its turn in its patch's plane; plane ids and kinds are handed
// down; new vertices lie within half an ulp per coordinate of a line or plane
// through original vertices of the patch, in all ≤ 2e-15 × the largest
// |coordinate| off the original patch.  The result depends on nothing but the
// input.
//
// Throws InputError where it would take more than 4M triangles.
void RefineSurface(const RefineOptions& options, ContactSpace* space);

}  // namespace phongpd::internal
