// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/world/obstacle_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/contact/contact_space.h"
#include "core/contact/joined_contact_spaces.h"
#include "core/mesh/mesh_error.h"
#include "planners/world/world.h"
#include "problems/shapes/random_solids.h"
#include "problems/shapes/shapes.h"
#include "tests/support/oracle_of.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

Solid BoxAt(const Vector3d& min, const Vector3d& max, const std::string& name) {
  return MakeSolid(MakeBox(min, max), name);
}

// Boxes with corners on a lattice, where contact spaces round nothing; some
// hollow, so that others may lie in their cavities.
std::vector<Solid> RandomObstacles(int count, std::mt19937_64* random) {
  std::uniform_int_distribution<int> place(-8, 8), size(1, 4), kind(0, 3);
  std::vector<Solid> solids;
  for (int i = 0; i < count; ++i) {
    Vector3d min, max;
    for (int k = 0; k < 3; ++k) {
      min[k] = place(*random);
      max[k] = min[k] + size(*random);
    }
    const std::string name = "b" + std::to_string(i);
    if (kind(*random) > 0) {
      solids.push_back(BoxAt(min, max, name));
      continue;
    }
    const Vector3d wall = Vector3d::Constant(4.0);
    solids.push_back(MakeSolid(
        Joined(MakeBox(min - wall, max + wall),
               Reversed(MakeBox(min - 0.75 * wall, max + 0.75 * wall))),
        name));
  }
  return solids;
}

// The points of a mesh, whatever their order.
std::multiset<std::array<double, 3>> Points(const TriangleMesh& mesh) {
  std::multiset<std::array<double, 3>> points;
  for (const Vector3d& v : mesh.vertices) points.insert({v[0], v[1], v[2]});
  return points;
}

// By another route: contact spaces of single obstacles, judged as solids; and
// the build of all of them at once.
TEST(ObstacleGroups, AreApartAndJoinToTheSpaceOfAll) {
  std::mt19937_64 random(4);
  const Solid robot =
      BoxAt(Vector3d::Constant(-0.25), Vector3d(0.5, 0.25, 0.75), "robot");
  int joined = 0, grouped = 0, with_cavities = 0;
  for (int round = 0; round < 60; ++round) {
    const std::vector<Solid> obstacles =
        RandomObstacles(2 + round % 5, &random);
    const auto groups = ObstacleGroups(robot, obstacles);
    std::vector<ContactSpace> parts;
    std::vector<int> seen;
    for (const std::vector<int>& group : groups) {
      std::vector<Solid> members;
      for (const int i : group) {
        members.push_back(obstacles[static_cast<std::size_t>(i)]);
        seen.push_back(i);
      }
      parts.push_back(
          BuildContactSpace(robot, JoinedSolids(members, "members")));
      grouped += members.size() > 1 ? 1 : 0;
    }
    std::sort(seen.begin(), seen.end());
    for (int i = 0; i < static_cast<int>(obstacles.size()); ++i) {
      ASSERT_EQ(seen[static_cast<std::size_t>(i)], i);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(testing::OracleOf(parts[i].mesh(), parts[j].mesh())
                         .Collides(Vector3d::Zero()))
            << "round " << round;
      }
    }
    const ContactSpace all =
        BuildContactSpace(robot, JoinedSolids(obstacles, "all"));
    const ContactSpace one = JoinedContactSpaces(parts);
    joined += groups.size() > 1 ? 1 : 0;
    with_cavities += all.report().cavities > 0 ? 1 : 0;
    EXPECT_EQ(Points(one.mesh()), Points(all.mesh())) << "round " << round;
    EXPECT_EQ(one.mesh().triangles.size(), all.mesh().triangles.size());
    EXPECT_EQ(one.report().components, all.report().components);
    EXPECT_EQ(one.report().genus, all.report().genus);
    EXPECT_EQ(one.report().cavities, all.report().cavities);
    EXPECT_DOUBLE_EQ(one.report().volume, all.report().volume);
    EXPECT_EQ(one.report().closed && one.report().manifold,
              all.report().closed && all.report().manifold);
    EXPECT_EQ(one.plane().size(), one.mesh().triangles.size());
    EXPECT_EQ(
        std::set<int>(one.plane().begin(), one.plane().end()).size(),
        static_cast<std::size_t>(
            1 + *std::max_element(one.plane().begin(), one.plane().end())));
  }
  EXPECT_GT(joined, 20);
  EXPECT_GT(grouped, 20);
  EXPECT_GT(with_cavities, 5);
}

// C_obj of unit boxes ends half the robot's side beyond them.
TEST(ObstacleGroups, TellWhatTheRobotMayTouchAtOnce) {
  const Solid robot = BoxAt({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, "robot");
  const auto count = [&](double gap) {
    return ObstacleGroups(robot, {BoxAt({0, 0, 0}, {1, 1, 1}, "a"),
                                  BoxAt({1 + gap, 0, 0}, {2 + gap, 1, 1}, "b")})
        .size();
  };
  EXPECT_EQ(count(0.5), 1U);
  EXPECT_EQ(count(1.0), 1U);   // it fits exactly, and touches both
  EXPECT_EQ(count(1.01), 2U);  // it passes
  // One deep in another, their surfaces far apart; and in its cavity.
  const Solid inner = BoxAt({-1, -1, -1}, {1, 1, 1}, "inner");
  const Solid body = BoxAt({-9, -9, -9}, {9, 9, 9}, "body");
  EXPECT_EQ(ObstacleGroups(robot, {inner, body}).size(), 1U);
  EXPECT_EQ(ObstacleGroups(robot, {body, inner}).size(), 1U);
  const Solid shell = MakeSolid(
      Joined(body, Reversed(MakeBox({-6, -6, -6}, {6, 6, 6}))), "shell");
  EXPECT_EQ(ObstacleGroups(robot, {shell, inner}).size(), 2U);
  EXPECT_TRUE(ObstacleGroups(robot, {}).empty());
}

TEST(JoinedContactSpaces, RefuseNoneAndKeepOne) {
  EXPECT_THROW(JoinedContactSpaces({}), InputError);
  const Solid box = BoxAt({0, 0, 0}, {1, 1, 1}, "box");
  const ContactSpace space = BuildContactSpace(box, box);
  EXPECT_TRUE(JoinedContactSpaces({space}).SharesWith(space));
}

// Five boxes in a row, within bounds that all but touch none of them.
Workspace Row(double last_x, double height) {
  Workspace workspace;
  workspace.robot = BoxAt({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, "robot");
  for (int i = 0; i < 5; ++i) {
    const double x = i < 4 ? 2.0 * i : last_x;
    workspace.obstacles.push_back(
        BoxAt({x, 0, 0}, {x + 1, 1, 1}, "b" + std::to_string(i)));
  }
  workspace.bounds = {{-2, -2, -2}, {12, 3, height}};
  return workspace;
}

TEST(World, BuildsAgainOnlyWhatMovedOrIsNew) {
  const std::string folder =
      ::testing::TempDir() + "phongpd_obstacle_groups_cache";
  std::filesystem::remove_all(folder);
  ContactSpaceCache cache;
  cache.directory = folder;
  const auto parts = [&](const Workspace& workspace, SpaceLayout layout) {
    const World world(workspace, "row", cache);
    const WorldSpaces& spaces = world.Spaces(layout);
    EXPECT_EQ(spaces.spaces.size(), 1U);
    EXPECT_EQ(spaces.spaces[0].length(), world.diagonal());
    EXPECT_EQ(world.Report().contact_spaces, 1);
    return std::array<int, 2>{world.Report().parts,
                              world.Report().parts_from_cache};
  };
  using Counts = std::array<int, 2>;
  EXPECT_EQ(parts(Row(8, 3), SpaceLayout::kMerged), (Counts{5, 0}));
  EXPECT_EQ(parts(Row(8, 3), SpaceLayout::kMerged), (Counts{5, 5}));
  EXPECT_EQ(parts(Row(8.5, 3), SpaceLayout::kMerged), (Counts{5, 4}));
  // The bounds are a part of their own, and the only one that they change.
  EXPECT_EQ(parts(Row(8.5, 3), SpaceLayout::kSealed), (Counts{6, 5}));
  EXPECT_EQ(parts(Row(8.5, 4), SpaceLayout::kSealed), (Counts{6, 5}));
  Workspace more = Row(8.5, 4);
  more.obstacles.push_back(BoxAt({4, 0, 2}, {5, 1, 2.5}, "new"));
  EXPECT_EQ(parts(more, SpaceLayout::kSealed), (Counts{7, 6}));
  // What comes near another is built with it.
  Workspace near = Row(7.1, 4);
  EXPECT_EQ(parts(near, SpaceLayout::kSealed), (Counts{5, 4}));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace phongpd
