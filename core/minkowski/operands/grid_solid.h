// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"
#include "core/minkowski/operands/exact_grid.h"

namespace phongpd::internal {

// An edge a→b with the facets on both sides: `left` contains a→b and its
// third vertex is `left_apex`; `right` contains b→a.
struct GridEdge {
  int a = 0, b = 0;
  int left_apex = 0, right_apex = 0;
  int left = 0, right = 0;
};

// One operand on the grid: closed, every facet of non-zero area.
struct GridSolid {
  std::vector<GridPoint> vertices;
  std::vector<Triangle> facets;
  std::vector<GridNormal> normals;          // of the facets, not reduced
  std::vector<GridEdge> edges;              // each undirected edge once
  std::vector<std::vector<int>> neighbors;  // vertices joined by an edge
};

// The same in grid steps, exactly: doubles hold grid points.
TriangleMesh ToMesh(const GridSolid& solid);

// Of each facet, exact in double.
std::vector<BoundingBox> FacetBoxes(const GridSolid& solid);

// What an operand's vertices were before they were rounded to the grid.
struct RoundedFrom {
  const TriangleMesh& mesh;  // user's frame, as MakeSolid returns it
  double step = 1.0;         // of the grid, user's unit
  double rounding = 1.0;     // no coordinate moved by more, user's unit
};

// The closed mesh with these vertices; with `reflect` through the origin as
// well (−A, facets turned).  Facets without area, which rounding to the grid
// may leave, are removed without changing the surface: coincident ends are
// joined, and a facet whose three corners are collinear gives its middle
// corner to its neighbour.  What rounding does beyond that is mended
// (grid_repair.h) if the vertices were rounded; null: they are exact.  Throws
// InputError naming `name` when no solid is left, and where.
GridSolid MakeGridSolid(const std::vector<GridPoint>& vertices,
                        const std::vector<Triangle>& triangles, bool reflect,
                        const std::string& name,
                        const RoundedFrom* rounded = nullptr);

}  // namespace phongpd::internal
