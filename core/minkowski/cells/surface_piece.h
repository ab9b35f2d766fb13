// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "core/minkowski/contact_space_report.h"
#include "core/minkowski/operands/exact_points.h"

namespace phongpd::internal {

// C_cont in one window (window_cells.h), as exact data that need nothing else:
// the faces between free and occupied space, cut off at the walls.  All
// coordinates in half grid steps.
struct SurfacePiece {
  struct Side {  // an oriented plane
    int plane = 0;
    bool is_reversed = false;  // faces look against the plane's normal
    ContactKind kind = ContactKind::kEdges;
  };
  struct Point {  // PointDefinition, its planes by number
    PointDefinition::Kind kind = PointDefinition::kVertex;
    GridPoint a{}, b{};
    Int128 side_a = 0, side_b = 0;
    std::array<int, 3> planes{};
  };
  struct Edge {  // HalfEdge
    int from = 0, to = 0;
    int next = 0;
    int walls = 0;  // bit k: lies in a wall across axis k
  };
  struct Face {
    int side = 0;
    int begin = 0, end = 0;  // its half-edges
    // Number of its cell where that is too thin in this window to be judged:
    // free if it goes on beyond a wall as one that is.  −1: judged free.
    int cell = -1;
  };

  std::vector<GridPlane> planes;
  std::vector<Side> sides;
  std::vector<Point> points;
  std::vector<Edge> edges;
  std::vector<Face> faces;
  // Of the window's arrangement.
  std::size_t arranged = 0, cells = 0, judged = 0;
};

PointDefinition DefinitionOf(const SurfacePiece& piece,
                             const SurfacePiece::Point& point);

// Numbers what is entered by first appearance.
class SurfacePieceWriter {
 public:
  int AddPlane(const GridPlane& plane);
  int AddSide(const GridPlane& plane, bool is_reversed, ContactKind kind);
  int AddPoint(int id, const PointDefinition& point);  // id: the caller's own
  SurfacePiece piece;

 private:
  std::unordered_map<GridPlane, int, GridPlaneHash> planes_;
  std::unordered_map<int, int> sides_, points_;
};

}  // namespace phongpd::internal
