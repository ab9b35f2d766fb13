// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "core/minkowski/build_limits.h"
#include "core/minkowski/convolution/convolution.h"
#include "core/minkowski/convolution/occupied_balls.h"
#include "core/minkowski/operands/grid_solid.h"

namespace phongpd::internal {

// Boxes of q-space in which the operands surely overlap, also a little beyond
// them: no point of the contact space is there, so that whatever facets do in
// them does not matter.
//
// A box is occupied if its circumscribed ball is (occupied_balls.h).  An
// octree, refined only where many facets are.
class OccupiedRegion {
 public:
  // Nothing is occupied.
  OccupiedRegion() = default;
  // Of B = `p` and −A = `q`; the facets say where to look.  Throws BuildRefusal
  // when `limits` are passed.
  OccupiedRegion(const GridSolid& p, const GridSolid& q,
                 const Convolution& convolution, const BuildLimits& limits);
  // The same in a box alone, of which the facets are: what they do elsewhere
  // does not count.
  OccupiedRegion(const OccupiedBalls& balls, const BoundingBox& box,
                 const Convolution& convolution, const BuildLimits& limits);

  bool IsEmpty() const { return root_ == nullptr; }
  // Is all of it occupied?  Grid steps, moved by up to a 32nd of a step.
  bool Contains(const BoundingBox& box) const;
  bool Contains(const Eigen::Vector3d corners[3]) const;
  bool Contains(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;

 private:
  struct Node {
    bool is_occupied = false;
    std::unique_ptr<std::array<Node, 8>> children;  // none: a leaf
  };
  struct Builder;
  void Build(const Builder& builder);
  // Is what a leaf meets occupied, wherever meets(box)?
  template <typename Meets>
  static bool ContainsPart(const Node& node, const BoundingBox& box,
                           const Meets& meets);

  std::unique_ptr<Node> root_;
  BoundingBox bounds_;
};

}  // namespace phongpd::internal
