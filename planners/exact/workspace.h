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
  // used twice, bounds that are not finite or hold no open set (min < max is
  // asked in each coordinate unless all are absent).
  void Validate() const;
};

// A box with a cavity that confines the robot to the bounds: q is free of it,
// within its hull, exactly when q lies strictly inside the bounds (up to the
// rounding of bounds + robot's bounding box).  Outward outer surface, inward
// inner one.  Requires bounds.
TriangleMesh BoundsShell(const Workspace& workspace);

// Indices of the obstacles the robot may touch at some q within the bounds:
// whose contact space has a bounding box that meets them.  The others need no
// contact space.  All of them without bounds.
std::vector<int> ReachableObstacles(const Workspace& workspace);

// The reachable obstacles as one operand of BuildContactSpace; components may
// overlap or touch, and C_cont is then the boundary of their union.  One row a
// sample for an optimiser.  May be empty.
TriangleMesh JoinedObstacle(const Workspace& workspace);

// The same with the bounds shell, if there are bounds: what cells of free
// space need.  Throws InputError if there is nothing.
TriangleMesh MergedObstacle(const Workspace& workspace);

// The bounding box of JoinedObstacle's contact space, without building it; the
// bounds where no obstacle is reachable.  Its diagonal D is the length that
// margins and smoothing lengths of a scene are fractions of.
BoundingBox ContactBounds(const Workspace& workspace);

}  // namespace phongpd
