// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// A fixed solid, placed, with the name the user knows it by.
struct Obstacle {
  std::string id;
  TriangleMesh mesh;  // as MakeSolid returns it
};

// What a robot that translates moves among.  Its position q moves the robot's
// mesh by q.  Lengths in one unit throughout.
struct Workspace {
  TriangleMesh robot;  // at q = 0, as MakeSolid returns it
  std::vector<Obstacle> obstacles;
  BoundingBox bounds = {Eigen::Vector3d::Constant(1.0),
                        Eigen::Vector3d::Constant(-1.0)};  // of q; empty: none

  // Throws InputError: an empty robot, an obstacle without triangles, an id
  // used twice, bounds that hold no open set (min < max is asked in each
  // coordinate unless all are absent).
  void Validate() const;
};

// A box with a cavity that confines the robot to the bounds: q is free of it,
// within its hull, exactly when q lies strictly inside the bounds (up to the
// rounding of bounds + robot's bounding box).  Outward outer surface, inward
// inner one.  Requires bounds.
TriangleMesh BoundsShell(const Workspace& workspace);

// All obstacles and the bounds shell, if there are bounds, as one operand of
// BuildContactSpace; components may overlap or touch, and C_cont is then the
// boundary of their union.  That is what cells of free space need, and one
// row a sample for an optimiser.  Throws InputError if there is nothing.
TriangleMesh MergedObstacle(const Workspace& workspace);

// Indices of the obstacles the robot can touch at some q within the bounds:
// whose Minkowski bounding box meets them.  All of them without bounds.
std::vector<int> ReachableObstacles(const Workspace& workspace);

}  // namespace phongpd
