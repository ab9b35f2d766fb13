// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/minkowski/convolution/gauss_tree.h"
#include "core/minkowski/operands/exact_grid.h"
#include "core/minkowski/operands/grid_solid.h"

// Which features of two solids can touch: the conditions of the reduced
// convolution (convolution.h), exact, one pair at a time, and caps of normals
// by which pairs that clearly cannot are left out.
namespace phongpd::internal {

// Vectors from every vertex to its neighbours, contiguous for the inner loop.
struct VertexStars {
  explicit VertexStars(const GridSolid& s);
  std::vector<int> begin;
  std::vector<Eigen::Vector3d> rays;
  std::vector<GridPoint> exact;
};

// The caps of the normals around every vertex.
//
// Let n·d ≤ 0 for all rays d at v, and let the normals mᵢ of the facets there
// lie in a cap of less than 90° around a.  Seen along a the facets cover every
// direction, and x ↦ n·x over them is piecewise linear with gradients gᵢ.  Were
// gᵢ·u > 0 for all i and one u, n·x would grow along u: so Σ wᵢ gᵢ = 0 for some
// wᵢ ≥ 0, which is n = ± Σ wᵢ mᵢ / |…|.  Hence n or −n is in the cap.
std::vector<GaussCap> VertexCaps(const GridSolid& s);

// A facet's normal, as it is asked for many vertices.
class TouchingFacet {
 public:
  // `turn` is +1 when the vertices belong to the turned operand Q, −1 when the
  // facet does.
  TouchingFacet(const GridNormal& normal, int turn);
  // Does no edge at v rise above the plane of the facet?
  bool Touches(const VertexStars& stars, int v) const;
  const Eigen::Vector3d& unit() const { return unit_; }

 private:
  GridNormal exact_;
  Eigen::Vector3d rounded_, unit_;
  double bound_;
  int turn_;
};

// A strictly convex edge: its direction and the two apex directions, and the
// unit normals of its facets.
struct ConvexEdge {
  int a, b;
  GridPoint exact[3];
  Eigen::Vector3d rounded[3];
  Eigen::Vector3d left_normal, right_normal;
};
std::vector<ConvexEdge> ConvexEdges(const GridSolid& s);

// The normals n with which an edge can be touched: those for which both apices
// lie below the plane through it, the arc between its facets' normals.  Edges
// touch where their arcs cross.
GaussCap ArcCap(const ConvexEdge& e);
std::vector<GaussCap> ArcCaps(const std::vector<ConvexEdge>& edges);

// Side of the plane spanned by e (of P) and g (of Q) on which all four apices
// lie, or 0: they cannot touch.
int CommonSide(const ConvexEdge& e, const ConvexEdge& g);

}  // namespace phongpd::internal
