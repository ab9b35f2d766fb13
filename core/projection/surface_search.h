// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/projection/surface_walk.h"

namespace phongpd {

// The points of a surface within `radius` of `center`.  Its part in a triangle
// is convex, so two neighbours hang together exactly where their edge meets
// the ball: pieces of it are told apart without error of sampling.
struct SurfaceBall {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
};

// Finds ways on a surface: best first over triangles, each entered at the
// point of its edge that lies straightest between where the way comes from and
// where it goes, then pulled taut across the edges it crosses.  The ways are
// short, not shortest.  What is held between searches is memory alone: no
// answer depends on it.
class SurfaceSearch {
 public:
  // Appends to *way a way from `start`, in the ball, that stays in the ball
  // and ends at `goal`; where the goal is in another piece of the ball, at the
  // point of the piece of `start` closest to the centre.
  void FindInside(const SurfaceWalk& walk, const SurfaceBall& ball,
                  const MeshPoint& start, const MeshPoint& goal,
                  SurfaceWay* way);
  // Appends to *way a way from `start` to the piece of the ball it reaches
  // first.  False, with *way as it was, if the component of `start` does not
  // meet the ball.
  bool FindBall(const SurfaceWalk& walk, const SurfaceBall& ball,
                const MeshPoint& start, SurfaceWay* way);

 private:
  // A way's best known entry into a triangle.
  struct Entry {
    std::uint64_t search = 0;  // the one that made it
    bool settled = false;
    int parent = -1;
    int edge = -1;  // of the parent, crossed at a + t (b − a)
    double t = 0.0;
    double cost = 0.0;  // length so far
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
  };
  // An edge that a way crosses, and where it may.
  struct Crossing {
    int triangle, edge;
    Eigen::Vector3d a, b;
    double low, high, t;
  };
  struct Goal;

  void Begin(const SurfaceWalk& walk, const MeshPoint& start, const Goal& goal);
  int NextTriangle();  // settled now; −1: none is left
  void Expand(const SurfaceWalk& walk, const Goal& goal, int triangle);
  void AppendWay(const SurfaceWalk& walk, const Goal& goal,
                 const Eigen::Vector3d& start, const MeshPoint& end,
                 SurfaceWay* way);

  std::uint64_t search_ = 0;
  std::vector<Entry> entries_;
  std::vector<std::pair<double, int>> heap_;
  std::vector<int> settled_;
  std::vector<Crossing> crossings_;
};

}  // namespace phongpd
