// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed boxes and their closed sums, by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "constraints/free_space.h"
#include "core/contact/contact_space.h"
#include "core/projection/euclidean_metric.h"
#include "core/solid/solid.h"
#include "planners/exact/contact_roadmap.h"
#include "planners/exact/contact_surface_planner.h"
#include "planners/world/workspace.h"
#include "problems/shapes/shapes.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// Touching is collision, for a point, a motion, a path, the planner and the
// proof alike.  A cube of side 1 among boxes; free by how much room it has.
struct Touching {
  const char* what;
  std::vector<std::array<Vector3d, 2>> boxes;
  Vector3d start, at, goal;
  bool touches;
};

// Obstacles that keep the unit robot out of all octants but some, which meet
// in the origin.
std::vector<std::array<Vector3d, 2>> OctantsBut(
    const std::vector<std::array<int, 3>>& open) {
  std::vector<std::array<Vector3d, 2>> boxes;
  for (int code = 0; code < 8; ++code) {
    std::array<int, 3> octant;
    Vector3d min, max;
    for (int k = 0; k < 3; ++k) {
      const bool high = (code >> k & 1) != 0;
      octant[static_cast<std::size_t>(k)] = high ? 1 : -1;
      min[k] = high ? 1.0 : -9.0;
      max[k] = high ? 9.0 : 0.0;
    }
    if (std::find(open.begin(), open.end(), octant) == open.end()) {
      boxes.push_back({min, max});
    }
  }
  return boxes;
}

TEST(Touching, IsCollisionForQueryJudgePlannerAndProof) {
  // Two slabs, which a frame of bounds makes the only way: the way through is
  // as wide as `gap`, the robot 1.
  const auto slot = [](double gap) {
    return std::vector<std::array<Vector3d, 2>>{
        {Vector3d(0, -9, -9), Vector3d(2, 0, 9)},
        {Vector3d(0, gap, -9), Vector3d(2, 9, 9)}};
  };
  const std::vector<Touching> cases = {
      {"peg of the slot's width",
       slot(1.0),
       {-3, 0, 0},
       {0, 0, 0},
       {4, 0, 0},
       true},
      {"peg half a unit narrower",
       slot(1.5),
       {-3, 0.25, 0},
       {0, 0.25, 0},
       {4, 0.25, 0},
       false},
      {"slot of no width",
       slot(0.0),
       {-3, 0, 0},
       {0, -0.5, 0},
       {4, 0, 0},
       true},
      {"rooms that meet in an edge",
       {{Vector3d(-9, -9, -9), Vector3d(0, 9, 0)},
        {Vector3d(1, -9, 1), Vector3d(9, 9, 9)}},
       {-3, 0, 3},
       {0, 0, 0},
       {3, 0, -3},
       true},
      {"rooms that meet in a point",
       OctantsBut({{1, 1, 1}, {-1, -1, -1}}),
       {-3, -3, -3},
       {0, 0, 0},
       {3, 3, 3},
       true},
  };
  for (const Touching& one : cases) {
    Workspace workspace;
    workspace.robot =
        MakeSolid(MakeBox(Vector3d::Zero(), Vector3d::Ones()), "robot");
    for (const auto& box : one.boxes) {
      workspace.obstacles.push_back(MakeSolid(
          MakeBox(box[0], box[1]), std::to_string(workspace.obstacles.size())));
    }
    workspace.bounds = {Vector3d(-6, -6, -6), Vector3d(6, 6, 6)};
    const TriangleMesh contact =
        BuildContactSpace(workspace.robot, MergedObstacle(workspace)).mesh();
    const FreeSpace space({TakeAsContactSpace(contact)}, workspace.bounds);
    EXPECT_EQ(space.IsFree(one.at), !one.touches) << one.what;
    EXPECT_EQ(space.IsFree(one.start, one.goal), !one.touches) << one.what;
    EXPECT_EQ(CheckPath(space, {one.start, one.at, one.goal}).free,
              !one.touches)
        << one.what;
    const ContactSurfacePlanner planner(TakeAsContactSpace(contact));
    const ContactRoadmap roadmap(TakeAsContactSpace(contact));
    const std::string wanted = one.touches ? "infeasible_proved" : "solved";
    EXPECT_EQ(ToString(planner.Plan(one.start, one.goal).status), wanted)
        << one.what;
    EXPECT_EQ(ToString(roadmap.Plan(one.start, one.goal).status), wanted)
        << one.what;
    if (!one.touches) continue;
    EXPECT_EQ(ToString(planner.Plan(one.at, one.goal).status),
              std::string("start_in_collision"));
    EXPECT_EQ(ToString(planner.Plan(one.start, one.at).status),
              std::string("goal_in_collision"));
  }
}

TEST(Touching, InAFaceAnEdgeOrAPointIsCollision) {
  // C_obj of the unit cube and a cube of side 3: (−1, 3)³, closed.
  const TriangleMesh contact =
      BuildContactSpace(MakeBox(Vector3d::Zero(), Vector3d::Ones()),
                        MakeBox(Vector3d::Zero(), Vector3d::Constant(3.0)))
          .mesh();
  const FreeSpace space({TakeAsContactSpace(contact)});
  const ContactSurfacePlanner planner(TakeAsContactSpace(contact));
  const EuclideanMetric metric(TakeAsContactSpace(contact));
  const Vector3d goal(8, 8, 8);
  for (const Vector3d& q : {Vector3d(3, 1, 1), Vector3d(3, 3, 1),
                            Vector3d(3, 3, 3), Vector3d(-1, 0.5, 3)}) {
    EXPECT_FALSE(space.IsFree(q));
    EXPECT_FALSE(space.IsFree(goal, q));
    EXPECT_FALSE(CheckPath(space, {goal, q}).free);
    EXPECT_EQ(ToString(planner.Plan(q, goal).status),
              std::string("start_in_collision"));
    EXPECT_NE(planner.Plan(q, goal).reason.find("touches"), std::string::npos);
    // The depth of a touch is zero, and it is not inside.
    EXPECT_FALSE(metric.Query(q).inside);
    EXPECT_EQ(metric.Query(q).signed_distance, 0.0);
  }
  // Past a face, an edge and a corner: the motion touches on the way.
  EXPECT_FALSE(space.IsFree({3, -5, 1}, {3, 8, 1}));
  EXPECT_FALSE(space.IsFree({2, 4, 1}, {4, 2, 1}));
  EXPECT_FALSE(space.IsFree({3, 3, -5}, {3, 3, 8}));
  EXPECT_FALSE(space.IsFree({3, 2, 4}, {3, 4, 2}));
  // And is planned around.
  for (const auto& [from, to] : std::vector<std::array<Vector3d, 2>>{
           {Vector3d(3, -5, 1), Vector3d(3, 8, 1)},
           {Vector3d(2, 4, 1), Vector3d(4, 2, 1)},
           {Vector3d(3, 3, -5), Vector3d(3, 3, 8)},
           {Vector3d(3, 2, 4), Vector3d(3, 4, 2)}}) {
    const PlanResult result = planner.Plan(from, to);
    EXPECT_EQ(ToString(result.status), std::string("solved"));
    EXPECT_TRUE(CheckPath(space, result.path).free);
  }
  // Nowhere to go: the start is the goal.
  EXPECT_EQ(planner.Plan(goal, goal).path, std::vector<Vector3d>{goal});
}

}  // namespace
}  // namespace phongpd
