// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "planners/rigid/rigid_plan.h"
#include "problems/shapes/shapes.h"
#include "tests/support/rigid_truth.h"

// Paths of poses, looked at by another route.
namespace phongpd::testing {

// A bar longer than the hole is wide has to turn to go through.
inline const TriangleMesh& WallWithHole() {
  static const TriangleMesh wall = MakePlateWithHole(6.0, 0.4, 1.6);
  return wall;
}
inline TriangleMesh LongBar() {
  return MakeBox({-1.0, -0.2, -0.2}, {1.0, 0.2, 0.2});
}

// The path has the ends asked for, keeps to the bounds, is as long as it says,
// and no triangle meets another at about so many of its moments.
inline void ExpectFreePath(const TriangleMesh& robot,
                           const TriangleMesh& obstacle,
                           const RigidRequest& request,
                           const RigidAnswer& answer, int moments) {
  ASSERT_GE(answer.path.size(), 2u);
  for (const auto& [found, asked] :
       {std::pair(answer.path.front(), request.start),
        std::pair(answer.path.back(), request.goal)}) {
    EXPECT_EQ(found.position, asked.position);
    EXPECT_EQ(found.orientation.coeffs(), asked.orientation.coeffs());
  }
  const RigidWorld world(robot, obstacle);
  double length = 0.0;
  const int parts = 2 + moments / static_cast<int>(answer.path.size() - 1);
  for (std::size_t i = 0; i + 1 < answer.path.size(); ++i) {
    const RigidMotion motion(answer.path[i], answer.path[i + 1]);
    length +=
        std::hypot((motion.end().position - motion.start().position).norm(),
                   world.gyration() * motion.angle());
    for (int k = 0; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      EXPECT_FALSE(MeetExactly(PlacedMesh(robot, motion, t), obstacle))
          << "motion " << i << " at " << t;
      EXPECT_TRUE(request.bounds.isEmpty() ||
                  request.bounds.contains(motion.At(t).position));
    }
  }
  EXPECT_NEAR(answer.length, length, 1e-9 * length);
}

}  // namespace phongpd::testing
