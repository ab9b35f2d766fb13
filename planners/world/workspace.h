// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/solid/solid.h"

namespace phongpd {

// A robot that translates, and its obstacles.  At position q the robot's mesh
// is moved by q.  All lengths are in one unit.
struct Workspace {
  Solid robot;                   // at q = 0
  std::vector<Solid> obstacles;  // fixed, by the names the user knows them by
  BoundingBox bounds = {Eigen::Vector3d::Constant(1.0),
                        Eigen::Vector3d::Constant(-1.0)};  // of q; empty: none
  // The name of the unit, one of UnitNames (length.h); empty: it has no name,
  // and lengths without a unit are shares of D.
  std::string unit{};

  // Throws InputError: an empty robot or obstacle, an obstacle's name used
  // twice, bounds that are not finite or hold no open set (if there are bounds,
  // min < max is required in each coordinate).
  void Validate() const;
};

// A box with a cavity that keeps the robot within the bounds.  In its hull, q
// is free of it exactly when q lies strictly inside the bounds (up to the
// rounding of bounds + robot's bounding box).  Its outer surface points
// outward, the inner one inward.  Requires bounds.
Solid BoundsShell(const Workspace& workspace);

// Indices of the obstacles that the robot may touch at some q within the
// bounds: those whose contact space has a bounding box that meets the bounds.
// The others need no contact space.  Without bounds: all obstacles.
std::vector<int> ReachableObstacles(const Workspace& workspace);

// The reachable obstacles as one operand of BuildContactSpace; components may
// overlap or touch, and C_cont is then the boundary of their union.  An
// optimiser has one row a sample with it.  May be empty.
Solid JoinedObstacle(const Workspace& workspace);

// The same with the bounds shell, if there are bounds: what cells of free
// space need.  Throws InputError if there is nothing.
Solid MergedObstacle(const Workspace& workspace);

// The names of all that the robot touches or is inside of at q, as "a, b";
// "bounds" may be one of them.  Empty if q is free.  Exact.
std::string NameObstacles(const Workspace& workspace, const Eigen::Vector3d& q);

// The bounding box of JoinedObstacle's contact space, found without building
// it; the bounds if no obstacle is reachable.  Its diagonal is D, of which
// margins and smoothing lengths of a scene are fractions.
BoundingBox ContactBounds(const Workspace& workspace);

}  // namespace phongpd
