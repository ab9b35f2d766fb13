// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/workspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/mesh/mesh_error.h"
#include "core/solid/solid.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

Workspace CubeAmongTwoBoxes() {
  Workspace workspace;
  workspace.robot =
      MakeSolid(MakeBox({-0.25, 0.0, 0.0}, {0.25, 0.5, 0.5}), "robot");
  workspace.obstacles = {
      MakeSolid(MakeBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}), "near"),
      MakeSolid(MakeBox({9.0, 9.0, 9.0}, {10.0, 10.0, 10.0}), "far")};
  workspace.bounds = {Vector3d::Constant(-2.0), Vector3d::Constant(2.0)};
  return workspace;
}

TEST(Workspace, ConfinesTheRobotExactlyToTheBounds) {
  const Workspace workspace = CubeAmongTwoBoxes();
  const Solid shell = BoundsShell(workspace);
  EXPECT_EQ(ExamineMesh(shell).boundary_edges, 0u);
  const ContactSpace contact = BuildContactSpace(workspace.robot, shell);
  EXPECT_EQ(contact.report().cavities, 1);
  const FreeSpace space({contact});
  EXPECT_TRUE(space.IsFree(Vector3d::Constant(1.999999)));
  EXPECT_TRUE(space.IsFree(Vector3d::Constant(-1.999999)));
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(space.IsFree(2.0 * Vector3d::Unit(k)));
    EXPECT_FALSE(space.IsFree(-2.0 * Vector3d::Unit(k)));
  }
}

TEST(Workspace, MergesWhatTheRobotCanReach) {
  Workspace workspace = CubeAmongTwoBoxes();
  EXPECT_EQ(ReachableObstacles(workspace), std::vector<int>{0});
  // One box and the shell: 12 + 24 triangles.
  EXPECT_EQ(MergedObstacle(workspace).mesh().triangles.size(), 36u);
  workspace.bounds = FreeSpace::NoBounds();
  EXPECT_EQ(ReachableObstacles(workspace), (std::vector<int>{0, 1}));
  EXPECT_EQ(MergedObstacle(workspace).mesh().triangles.size(), 24u);
}

// C_obj of `near` ends at x = 0.75, the bounds at 2.
TEST(Workspace, NamesWhatTheRobotTouchesToTheLastBit) {
  const Workspace workspace = CubeAmongTwoBoxes();
  const auto names = [&](double x) {
    return NameObstacles(workspace, {x, 0.0, 0.0});
  };
  EXPECT_EQ(names(0.0), "near");
  EXPECT_EQ(names(0.75), "near");
  EXPECT_EQ(names(std::nextafter(0.75, 1.0)), "");
  EXPECT_EQ(names(std::nextafter(2.0, 0.0)), "");
  EXPECT_EQ(names(2.0), "bounds");
}

TEST(Workspace, RefusesWhatCannotBeBuilt) {
  const Workspace valid = CubeAmongTwoBoxes();
  EXPECT_NO_THROW(valid.Validate());
  Workspace workspace = valid;
  workspace.robot = {};
  EXPECT_THROW(workspace.Validate(), InputError);
  workspace = valid;
  workspace.obstacles[1] = workspace.obstacles[1].Named("near");
  EXPECT_THROW(workspace.Validate(), InputError);
  workspace = valid;
  workspace.bounds.max.y() = -2.0;
  EXPECT_THROW(workspace.Validate(), InputError);
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    workspace.bounds.max.y() = bad;
    EXPECT_THROW(workspace.Validate(), InputError) << bad;
  }
}

}  // namespace
}  // namespace phongpd
