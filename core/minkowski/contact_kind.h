// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace phongpd {

// What touches what on a piece of contact surface.
enum class ContactKind {
  kObstacleFacet,  // facet of the obstacle on a vertex of the robot
  kRobotFacet,     // vertex of the obstacle on a facet of the robot
  kEdges,          // an edge of each
  kNone,           // nothing: a wall around what was modelled
};

}  // namespace phongpd
