// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/cells/surface_piece.h"
#include "core/minkowski/convolution/window_convolution.h"
#include "core/minkowski/operands/solid_collision.h"
#include "core/minkowski/windows/grid_window.h"

namespace phongpd::internal {

// The free space of a window, for whoever goes from window to window: rooms are
// its connected parts, and what is too thin to be judged here.
struct WindowRooms {
  struct Opening {  // through which a room goes on beyond a wall
    int patch = 0;
    BoundingBox box;  // around it, half steps
  };
  struct Room {
    std::vector<Opening> openings;
  };
  std::vector<Room> rooms;
  // The rooms' boundary: faces of C_cont, and of the walls what is open.
  SurfacePiece piece;
  std::vector<int> room;   // per face
  std::vector<int> patch;  // per face; −1: of C_cont
};

// The part of C_cont in a window, exactly: the convolution's facets there and
// the six walls as facets of their own, which look into the window, so that
// all outside counts as occupied, are arranged as for a full build.  A cell
// that looks at the back of any facet is occupied; of the others those that
// somebody asks about are judged by one collision test.
class WindowCells {
 public:
  // `window` holds what FeatureSums::Within told of it.  Keeps a reference to
  // `judge`.  Throws InputError when `limits` are passed.
  WindowCells(const WindowConvolution& sums, const GridWindow& window,
              const SolidCollision& judge, const BuildLimits& limits);
  // The same where the walls are made up of patches.
  WindowCells(const WindowConvolution& sums, const GridWindow& window,
              const std::vector<WallPatch>& patches,
              const SolidCollision& judge, const BuildLimits& limits);
  ~WindowCells();

  // The point of C_cont in the window nearest to q, grid steps.
  struct Nearest {
    bool found = false;
    double distance = 0.0;  // 0 exactly when q lies on C_cont
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // of the facet, outward
    int facet = -1;  // of the convolution, holds the point
  };
  Nearest FindNearest(const Eigen::Vector3d& q);

  // C_cont in the window; judges every cell that has a facet.
  SurfacePiece Surface();

  // Judges every cell.
  WindowRooms Rooms();
  // Of these the one that a free q in the window is in: more than one where
  // rounding could decide.
  std::vector<int> RoomsAt(const Eigen::Vector3d& q);

  // Area of C_cont in the window, grid steps squared; judges every cell.
  double SurfaceArea();
  int FaceCount() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd::internal
