// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exact judge, and closed forms of shortest paths.
#include "planners/exact/start_repair.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/mesh/mesh_error.h"
#include "core/pi.h"
#include "problems/shapes/shapes.h"
#include "tests/support/path_problems.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::MakePathProblem;
using testing::PathFamilies;
using testing::PathProblem;
using Path = std::vector<Vector3d>;

TriangleMesh CentredCube(double half) {
  return MakeBox(Vector3d::Constant(-half), Vector3d::Constant(half));
}

// A solid box with a box-shaped cavity that holds a smaller solid box.
TriangleMesh Nested() {
  return Joined(MakeVessel(6.0, 4.0, 0.0), CentredCube(0.5));
}

TEST(StartRepair, FreesEveryPathOfTheFamilies) {
  for (const std::string& family : PathFamilies()) {
    std::unique_ptr<StartRepair> repair;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const PathProblem problem = MakePathProblem(family, seed);
      if (repair == nullptr || family == "clutter") {
        repair =
            std::make_unique<StartRepair>(TakeAsContactSpace(problem.contact));
      }
      const StartRepairResult result =
          repair->Repair(problem.start, problem.goal);
      ASSERT_EQ(result.status, PathStatus::kRepaired)
          << family << ' ' << seed << ": " << result.reason;
      ASSERT_EQ(result.routes.size(), 1u);
      const Path& path = result.routes[0];
      EXPECT_EQ(path.size(), 42u);
      EXPECT_EQ(path.front(), problem.start);
      EXPECT_EQ(path.back(), problem.goal);
      EXPECT_TRUE(CheckPath(repair->space(), path).free) << family << seed;
      EXPECT_EQ(result.runs, 1);
      EXPECT_TRUE(result.reason.empty());
    }
  }
}

TEST(StartRepair, GoesTheShortestWayAroundABox) {
  // From (−2, 0, 0.9) over the top edge (z = 1) of a cube and down again:
  // straight to the edge, across, straight to the goal.
  const StartRepair repair(TakeAsContactSpace(CentredCube(1.0)));
  const Vector3d start(-2.0, 0.0, 0.9), goal(2.0, 0.0, 0.9);
  StartRepairOptions options;
  options.clearance = 1e-4 * repair.diagonal();
  const StartRepairResult result = repair.Repair(start, goal, options);
  ASSERT_EQ(result.status, PathStatus::kRepaired);
  const double shortest = 2.0 * std::hypot(1.0, 0.1) + 2.0;
  EXPECT_GE(PathLength(result.routes[0]), shortest);
  EXPECT_LE(PathLength(result.routes[0]), 1.01 * shortest);
}

TEST(StartRepair, GoesNearlyTheShortestWayAroundABall) {
  // Between opposite points at distance 2 of a unit ball: two tangents of
  // length √3 and an arc of 60°.  The mesh is inside the ball and the path
  // outside the mesh by the margin.
  const StartRepair repair(TakeAsContactSpace(MakeIcoBall(1.0, 4)));
  const Vector3d start(-2.0, 0.1, 0.05), goal = -start;
  const double distance = start.norm();
  const double tangent = std::sqrt(distance * distance - 1.0);
  const double arc = kPi - 2.0 * std::acos(1.0 / distance);
  const StartRepairResult result = repair.Repair(start, goal);
  ASSERT_EQ(result.status, PathStatus::kRepaired);
  EXPECT_GE(PathLength(result.routes[0]), 0.995 * (2.0 * tangent + arc));
  EXPECT_LE(PathLength(result.routes[0]), 1.04 * (2.0 * tangent + arc));
}

TEST(StartRepair, LeavesFreePathsAsTheyAre) {
  const StartRepair repair(TakeAsContactSpace(CentredCube(1.0)));
  const Path given = {{-2.0, 0.0, 0.0}, {-2.0, 2.0, 0.0}, {2.0, 2.0, 0.5}};
  const StartRepairResult result = repair.Repair(given);
  EXPECT_EQ(result.status, PathStatus::kFree);
  ASSERT_EQ(result.routes.size(), 1u);
  EXPECT_NEAR(PathLength(result.routes[0]), PathLength(given), 1e-12);
  EXPECT_EQ(result.runs, 0);
}

TEST(StartRepair, LeadsOnlyCollidingPartsOfAPolylineAround) {
  const TriangleMesh two =
      Joined(CentredCube(1.0), Translated(CentredCube(1.0), {10.0, 0.0, 0.0}));
  const StartRepair repair(TakeAsContactSpace(two));
  // Far up between the two cubes, on purpose.
  const Path given = {{-3.0, 0.0, 0.0}, {5.0, 0.3, 0.0},  {5.0, 0.0, 8.0},
                      {5.0, -0.3, 0.0}, {13.0, 0.0, 0.0}, {13.0, 0.0, 9.0},
                      {13.0, 5.0, 0.0}};
  const StartRepairResult result = repair.Repair(given);
  ASSERT_EQ(result.status, PathStatus::kRepaired) << result.reason;
  EXPECT_EQ(result.runs, 2);
  EXPECT_TRUE(CheckPath(repair.space(), result.routes[0]).free);
  EXPECT_EQ(result.routes[0].front(), given.front());
  EXPECT_EQ(result.routes[0].back(), given.back());
}

TEST(StartRepair, ProvesThatNoPathExists) {
  const StartRepair repair(TakeAsContactSpace(Nested()));
  const Vector3d inside(1.0, 0.2, 0.1), outside(4.0, 0.3, 0.2);
  const StartRepairResult result = repair.Repair(inside, outside);
  EXPECT_EQ(result.status, PathStatus::kInfeasibleProved);
  EXPECT_TRUE(result.routes.empty());
  EXPECT_FALSE(result.reason.empty());
  // Inside the cavity, around the box in it.
  const StartRepairResult around =
      repair.Repair(Vector3d(1.0, 0.2, 0.1), Vector3d(-1.0, 0.1, 0.2));
  EXPECT_EQ(around.status, PathStatus::kRepaired);
  // Through the cavity from outside to outside: around the whole.
  const StartRepairResult through =
      repair.Repair(Path{{4.0, 0.1, 0.2}, {3.5, 0.15, 0.2}, {-4.0, 0.3, 0.2}});
  EXPECT_EQ(through.status, PathStatus::kRepaired) << through.reason;
}

TEST(StartRepair, SaysWhichEndCollides) {
  const StartRepair repair(TakeAsContactSpace(CentredCube(1.0)));
  const Vector3d free(3.0, 0.0, 0.0), inside(0.5, 0.0, 0.0);
  EXPECT_EQ(repair.Repair(inside, free).status, PathStatus::kStartInCollision);
  EXPECT_EQ(repair.Repair(free, inside).status, PathStatus::kGoalInCollision);
  // Touching is not free.
  EXPECT_EQ(repair.Repair(Vector3d(1.0, 0.0, 0.0), free).status,
            PathStatus::kStartInCollision);
}

TEST(StartRepair, FindsDifferentRoutes) {
  const PathProblem problem = MakePathProblem("plate0.1", 3);
  const StartRepair repair(TakeAsContactSpace(problem.contact));
  StartRepairOptions options;
  options.routes = 3;
  const StartRepairResult result =
      repair.Repair(problem.start, problem.goal, options);
  ASSERT_GE(result.routes.size(), 2u);
  for (std::size_t i = 0; i < result.routes.size(); ++i) {
    EXPECT_TRUE(CheckPath(repair.space(), result.routes[i]).free);
    if (i == 0) continue;
    EXPECT_LE(PathLength(result.routes[i - 1]), PathLength(result.routes[i]));
  }
}

TEST(StartRepair, DoesNotDependOnUnitAndOffset) {
  const PathProblem problem = MakePathProblem("Uaxis", 1);
  const StartRepair base(TakeAsContactSpace(problem.contact));
  const StartRepairResult expected = base.Repair(problem.start, problem.goal);
  ASSERT_EQ(expected.status, PathStatus::kRepaired);
  const double length = PathLength(expected.routes[0]);
  for (const double scale : {1e-3, 1e3}) {
    for (const double shift : {0.0, 1e3}) {
      const Vector3d offset = scale * shift * Vector3d(1.0, -0.5, 0.7);
      const StartRepair repair(TakeAsContactSpace(
          Translated(Scaled(problem.contact, scale), offset)));
      const StartRepairResult result = repair.Repair(
          scale * problem.start + offset, scale * problem.goal + offset);
      ASSERT_EQ(result.status, PathStatus::kRepaired) << scale << shift;
      EXPECT_TRUE(CheckPath(repair.space(), result.routes[0]).free);
      EXPECT_NEAR(PathLength(result.routes[0]) / scale, length, 0.02 * length);
    }
  }
}

TEST(StartRepair, IsDeterministic) {
  const PathProblem problem = MakePathProblem("cone_axes", 2);
  const StartRepair one(TakeAsContactSpace(problem.contact)),
      other(TakeAsContactSpace(problem.contact));
  const StartRepairResult a = one.Repair(problem.start, problem.goal);
  const StartRepairResult b = other.Repair(problem.start, problem.goal);
  EXPECT_EQ(a.routes, b.routes);
  EXPECT_EQ(a.lift.tests, b.lift.tests);
}

TEST(StartRepair, RefusesBadInput) {
  const StartRepair repair(TakeAsContactSpace(CentredCube(1.0)));
  const Vector3d q(3.0, 0.0, 0.0);
  EXPECT_THROW(repair.Repair(Path{q}), InputError);
  EXPECT_THROW(repair.Repair(q, Vector3d::Constant(std::nan(""))), InputError);
  const Vector3d far(0.0, HUGE_VAL, 0.0);
  EXPECT_THROW(repair.Repair(Path{q, far, -q}), InputError);
  StartRepairOptions options;
  options.waypoints = 0;
  EXPECT_THROW(repair.Repair(q, -q, options), InputError);
  options = {};
  options.clearance = -1.0;
  EXPECT_THROW(repair.Repair(q, -q, options), InputError);
  options = {};
  options.routes = 9;
  EXPECT_THROW(repair.Repair(q, -q, options), InputError);
}

TEST(StartRepair, SaysSoWhenCornersOutnumberWaypoints) {
  const PathProblem problem = MakePathProblem("Uaxis", 0);
  const StartRepair repair(TakeAsContactSpace(problem.contact));
  StartRepairOptions options;
  options.waypoints = 1;
  const StartRepairResult result =
      repair.Repair(problem.start, problem.goal, options);
  EXPECT_EQ(result.status, PathStatus::kFailed);
  EXPECT_NE(result.reason.find("corners"), std::string::npos);
}

}  // namespace
}  // namespace phongpd
