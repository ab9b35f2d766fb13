// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/contact_space/exact_grid.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd::internal {

// Places both operands on one integer grid.  Each operand is taken relative
// to its own centre, so that neither loses bits to an offset:
//   a = robot_center + step · i,   b = obstacle_center + step · j,
//   q = b − a = origin + step · (j − i).
struct GridFrame {
  double step = 1.0;  // a power of two, user's unit
  Eigen::Vector3d robot_center = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_center = Eigen::Vector3d::Zero();

  Eigen::Vector3d Origin() const { return obstacle_center - robot_center; }
};

// The finest grid with kGridBits bits for the larger operand.
GridFrame ChooseGridFrame(const TriangleMesh& robot,
                          const TriangleMesh& obstacle);

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

// Rounds a closed mesh to the grid; with `reflect` through the origin as well
// (−A, facets turned).  Facets that the rounding makes degenerate are removed
// without changing the surface: coincident ends are joined, and a facet whose
// three corners are collinear gives its middle corner to its neighbour.
// What rounding does beyond that is mended (grid_repair.h).
// Throws InputError naming `name` when no solid is left; places are said in
// the user's frame, where the mesh is `in_user_frame` if not null.
GridSolid MakeGridSolid(const TriangleMesh& mesh, const Eigen::Vector3d& center,
                        double step, bool reflect, const std::string& name,
                        const TriangleMesh* in_user_frame = nullptr);

}  // namespace phongpd::internal
