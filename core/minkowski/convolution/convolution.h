// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/minkowski/contact_space_report.h"
#include "core/minkowski/operands/exact_grid.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

class BuildLimits;

struct ConvolutionFacet {
  Triangle corners;   // into Convolution::points, outward
  GridNormal normal;  // exact, outward, not reduced
  // Facets with the same source lie in one plane and share their interior:
  // the two halves of a parallelogram have one.
  int source = 0;
  ContactKind kind = ContactKind::kEdges;
};

// The reduced convolution P ∗ Q: a closed, self-intersecting, oriented set of
// triangles that contains the boundary of P ⊕ Q.
struct Convolution {
  std::vector<GridPoint> points;  // distinct
  std::vector<ConvolutionFacet> facets;
};

// Keeps only the pairs that can touch locally:
//   facet f ⊕ vertex v  when no edge at v rises above the plane of f;
//   edge e ⊕ edge g     when both are strictly convex and their four other
//                       apices lie on one side of the plane spanned by e, g.
// Exact ties (parallel features) are decided as if Q had been turned about one
// fixed axis by an infinitesimal angle (symbolic_turn.h): consistent for all
// three kinds, so nothing is missed and parallel facets are not generated
// twice.
// Source of the conditions: Kaul & Rossignac; Lien, "Covering Minkowski sum
// boundary", 2008.
//
// Throws BuildRefusal when `limits`, if there are any, are passed.
Convolution ReducedConvolution(const GridSolid& p, const GridSolid& q,
                               const BuildLimits* limits = nullptr);

}  // namespace phongpd::internal
