// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh/union_find.h"
#include "core/minkowski/arrangement/plane_arrangement.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// Face i of the arrangement has two sides: 2i looks along its normal (+),
// 2i + 1 against it (−).
inline int PlusSide(int face) { return 2 * face; }
inline int MinusSide(int face) { return 2 * face + 1; }
inline int OppositeSide(int side) { return side ^ 1; }

// The faces around one edge of the arrangement, counter-clockwise seen
// against the direction low → high.
struct RadialEdge {
  int low = 0, high = 0;   // ExactPoints ids, low < high
  int begin = 0, end = 0;  // into RadialEdges::spokes
};
struct Spoke {
  int half_edge = 0;
  int face = 0;
  bool forward = false;  // the half-edge runs low → high

  // The side that looks towards the next and the previous spoke.
  int SideToNext() const { return forward ? PlusSide(face) : MinusSide(face); }
  int SideToPrevious() const { return OppositeSide(SideToNext()); }
};
struct RadialEdges {
  std::vector<RadialEdge> edges;
  std::vector<Spoke> spokes;
};

// Sorts the faces around every edge.  All of them contain the edge, so their
// order follows from the facet normals alone: in double where the angles are
// clearly apart, else in exact integers.  Throws BuildRefusal when `limits`, if
// there are any, are passed.
RadialEdges SortAroundEdges(const Convolution& convolution,
                            const Arrangement& arrangement,
                            const ExactPoints& points,
                            const BuildLimits* limits = nullptr);

// The 2·`faces` sides, joined where they face each other around an edge: sides
// of one set look into one cell.  A cell whose boundary has several parts that
// share no edge has a set for each.
UnionFind JoinSides(const RadialEdges& radial, std::size_t faces);

}  // namespace phongpd::internal
