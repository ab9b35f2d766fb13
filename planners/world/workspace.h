// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/solid/solid.h"

namespace phongpd {

// What a robot that translates moves among.  Its position q moves the robot's
// mesh by q.  Lengths in one unit throughout.
struct Workspace {
  Solid robot;                   // at q = 0
  std::vector<Solid> obstacles;  // fixed, by the names the user knows them by
  BoundingBox bounds = {Eigen::Vector3d::Constant(1.0),
                        Eigen::Vector3d::Constant(-1.0)};  // of q; empty: none
  // What the unit of its lengths is called, one of UnitNames (length.h); empty:
  // it has no name, and lengths without a unit are shares of D.
  std::string unit{};

  // Throws InputError: an empty robot or obstacle, an obstacle's name used
  // twice, bounds that are not finite or hold no open set (min < max is
  // asked in each coordinate unless all are absent).
  void Validate() const;
};

// A box with a cavity that confines the robot to the bounds: q is free of it,
// within its hull, exactly when q lies strictly inside the bounds (up to the
// rounding of bounds + robot's bounding box).  Outward outer surface, inward
// inner one.  Requires bounds.
Solid BoundsShell(const Workspace& workspace);

// Indices of the obstacles the robot may touch at some q within the bounds:
// whose contact space has a bounding box that meets them.  The others need no
// contact space.  All of them without bounds.
std::vector<int> ReachableObstacles(const Workspace& workspace);

// The reachable obstacles as one operand of BuildContactSpace; components may
// overlap or touch, and C_cont is then the boundary of their union.  One row a
// sample for an optimiser.  May be empty.
Solid JoinedObstacle(const Workspace& workspace);

// The same with the bounds shell, if there are bounds: what cells of free
// space need.  Throws InputError if there is nothing.
Solid MergedObstacle(const Workspace& workspace);

// The names of what the robot touches or is in at q, "a, b", "bounds" among
// them; empty where it is free.  Exact.
std::string NameObstacles(const Workspace& workspace, const Eigen::Vector3d& q);

// The bounding box of JoinedObstacle's contact space, without building it; the
// bounds where no obstacle is reachable.  Its diagonal D is the length that
// margins and smoothing lengths of a scene are fractions of.
BoundingBox ContactBounds(const Workspace& workspace);

}  // namespace phongpd
