// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/bvh/triangle_bvh.h"
#include "core/minkowski/operands/coarse_depth.h"
#include "core/minkowski/operands/grid_solid.h"
#include "core/minkowski/operands/inner_balls.h"

namespace phongpd::internal {

// Balls of q-space in which the operands surely overlap.
//
// With s in −A, q − s in the inside of B puts q inside B ⊕ (−A); likewise with
// points of B and the inside of −A.  So a ball is occupied if, moved by −s for
// one of some points s of either operand, it lies inside the other one, by
// winding numbers.  The points are centers of balls in the operands, which it
// may then be larger by, and of those without cavities some of the surface.
class OccupiedBalls {
 public:
  enum class Asked {
    kSeldom,  // a few balls, nothing prepared
    kOften,   // many, and a grid of depths: tens of thousands of distances
  };
  // Of B = `p` and −A = `q`, grid steps.
  OccupiedBalls(const GridSolid& p, const GridSolid& q, Asked asked);

  // One of the balls moved to a solid, and how far it reaches into that at the
  // most (its radius and the depth of its center); < 0: apart.
  struct Sample {
    double overlap;
    int solid, ball;
    int near = -1;  // position of a triangle that was the closest nearby
  };
  // All of them, nothing known.
  std::vector<Sample> Samples() const;

  // Sets what the sample overlaps by with `center` as configuration, or a bound
  // of it that tells whether it is above `wanted`, and tells.
  bool Overlaps(const Eigen::Vector3d& center, double wanted, Sample* s) const;

  // Is the ball surely occupied?  Tries first what *last says and leaves there
  // what was found; 0 to begin with.
  bool Contain(const Eigen::Vector3d& center, double radius, int* last) const;

  // What a ball's radius is to be larger by, because points are rounded.
  double margin() const { return margin_; }

 private:
  std::array<TriangleBvh, 2> solids_;
  std::array<bool, 2> holds_surface_;  // surely is all of its surface in it
  std::vector<CoarseDepth> depths_;    // in them; none: seldom asked
  std::array<std::vector<InnerBall>, 2> balls_;  // to move into each solid
  double margin_ = 0.0;
};

}  // namespace phongpd::internal
