// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/minkowski/convolution/cone_tree.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/touching_features.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// What a facet of the convolution is the sum of, by its kind: facet of P and
// vertex of Q, vertex of P and facet of Q, or an edge of each (ConvexEdge).
struct SumOrigin {
  int of_p = 0, of_q = 0;
};

// Those facets of the reduced convolution that meet a box, and perhaps some
// that do not.
struct WindowConvolution {
  Convolution convolution;
  std::vector<SumOrigin> origins;  // of its facets
};

// Does the triangle come clearly nowhere near the box?
bool IsClearlyApart(const Eigen::Vector3d corners[3], const BoundingBox& box);

// Two operands ready to tell the part of their reduced convolution in any box:
// trees with boxes and cones of normals over the features of each.  One
// traversal of two trees leaves out pairs that clearly cannot touch, or whose
// sum is clearly elsewhere; all others are decided as ReducedConvolution does.
class FeatureSums {
 public:
  // Keeps references.
  FeatureSums(const GridSolid& p, const GridSolid& q);

  // Grid steps.
  WindowConvolution Within(const BoundingBox& window) const;
  // The same, or nothing as soon as more than `most` sums are found: boxes of
  // two features whose sum meets the window, and which touch.
  std::optional<WindowConvolution> Within(const BoundingBox& window,
                                          std::size_t most) const;

  // Of all sums, grid steps.
  const BoundingBox& bounds() const { return bounds_; }
  const ConvexEdge& EdgeOfP(int e) const { return p_.edges[e]; }
  const ConvexEdge& EdgeOfQ(int e) const { return q_.edges[e]; }

 private:
  struct Operand {
    // `turn` is that of its facets (TouchingFacet).
    Operand(const GridSolid& s, int turn);
    const GridSolid& solid;
    std::vector<TouchingFacet> touching;  // per facet
    VertexStars stars;
    std::vector<ConvexEdge> edges;
    ConeTree vertices, facets, arcs;
  };

  Operand p_, q_;
  BoundingBox bounds_;
};

}  // namespace phongpd::internal
