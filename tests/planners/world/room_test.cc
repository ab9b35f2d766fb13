// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the distance of a point to the contact space.
#include "planners/world/room.h"

#include <gtest/gtest.h>

#include <random>

#include "core/solid/solid.h"
#include "planners/world/world.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

TEST(Room, IsTheDistanceToTheContactSpaceAndTheBounds) {
  Workspace workspace;
  workspace.robot =
      MakeSolid(MakeBox({-0.1, -0.2, -0.3}, {0.3, 0.2, 0.1}), "r");
  workspace.obstacles = {
      MakeSolid(MakeBox({1, 1, 1}, {2, 1.5, 3}), "a"),
      MakeSolid(MakeBox({-2, -1, -0.5}, {-1.5, 0, 0.2}), "b")};
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> within(-3.5, 3.5);
  for (const bool has_bounds : {false, true}) {
    if (has_bounds) {
      workspace.bounds = {Vector3d::Constant(-3.0), Vector3d::Constant(3.0)};
    }
    const World world(workspace);
    const FreeSpace& space = *world.Spaces(SpaceLayout::kMerged).free_space;
    int free = 0;
    for (int i = 0; i < 500; ++i) {
      const Vector3d q(within(random), within(random), within(random));
      const bool is_free = space.IsFree(q);
      free += is_free ? 1 : 0;
      EXPECT_NEAR(Room(workspace, q), is_free ? space.Clearance(q) : 0.0,
                  1e-12);
    }
    EXPECT_GT(free, 200);
    EXPECT_LT(free, 500);
  }
}

}  // namespace
}  // namespace phongpd
