// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include "constraints/rigid/framed_motion.h"
#include "constraints/rigid/rigid_descent.h"
#include "constraints/rigid/rigid_judge.h"
#include "constraints/rigid/rigid_side.h"

// The questions of the judge about one motion in its frame.  None allocates.
namespace phongpd::internal {

// Both sides in one frame.
struct RigidSides {
  RigidFrame frame;
  RigidSide robot, obstacle;
};

RigidCheck SearchAnyHit(const RigidSides& sides, const FramedMotion& motion,
                        long max_tests);
// With pairs of triangles that are not told apart decided exactly; allocates.
RigidCheck SearchExactly(const RigidSides& sides, const FramedMotion& motion,
                         const QuaternionMotion& given, long max_tests);
RigidFirstHit SearchFirstHit(const RigidSides& sides,
                             const FramedMotion& motion, double resolution,
                             long max_tests);

// Motions below are not halved further: of half the robot's diagonal, and of
// the rounding.
inline constexpr double kRigidResolution = 1e-7;
inline constexpr double kRigidSlacks = 4.0;
// What is undecided is looked at further, for a collision, but not forever.
inline constexpr long kFurtherRigidTests = 10'000;

inline double ResolutionOf(const RigidSides& sides,
                           const FramedMotion& motion) {
  return std::max(kRigidResolution * sides.robot.tree.size,
                  kRigidSlacks * motion.slack());
}

// Does one side hold a part of the other at the start?  For surfaces that stay
// apart by more than rounding there: corners as rounded tell.
bool IsInsideAtStart(const RigidSides& sides, const FramedMotion& motion);

// The names of a pair of triangles, by their numbers in the trees.
template <typename Answer>
void NameTriangles(const RigidSides& sides, int robot, int obstacle,
                   Answer* answer) {
  const RigidOrigin& mine =
      sides.robot.origins[static_cast<std::size_t>(robot)];
  const RigidOrigin& its =
      sides.obstacle.origins[static_cast<std::size_t>(obstacle)];
  answer->robot_mesh = mine.mesh;
  answer->robot_triangle = mine.triangle;
  answer->obstacle_mesh = its.mesh;
  answer->obstacle_triangle = its.triangle;
}

}  // namespace phongpd::internal
