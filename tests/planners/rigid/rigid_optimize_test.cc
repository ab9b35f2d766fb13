// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the robot placed by another route at many moments of each path, in
// CGAL's exact kernel; lengths in closed form.
#include "planners/rigid/optimizer/rigid_optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "problems/shapes/shapes.h"
#include "tests/support/expect_refused.h"
#include "tests/support/rigid_paths.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;
using testing::Cube, testing::ExpectRefused, testing::LongBar, testing::PoseAt,
    testing::WallWithHole;

RigidOptimizeRequest ThroughTheWall(RigidStart from) {
  RigidOptimizeRequest request;
  request.task.start = PoseAt({0.2, 0.1, 2.0});
  request.task.goal =
      PoseAt({-0.3, 0.2, -2.0},
             Quaterniond(AngleAxisd(0.4, Vector3d(0, 1, 1).normalized())));
  request.task.bounds = {Vector3d(-2.5, -2.5, -3.0), Vector3d(2.5, 2.5, 3.0)};
  request.task.time_limit = 300.0;
  request.from = from;
  return request;
}

void ExpectFreePath(const TriangleMesh& robot, const TriangleMesh& obstacle,
                    const RigidOptimizeRequest& request,
                    const RigidOptimum& found) {
  ASSERT_TRUE(HasFreePath(found.answer.status)) << found.answer.reason;
  testing::ExpectFreePath(robot, obstacle, request.task, found.answer, 300);
}

TEST(RigidOptimize, TurnsABarThroughAHoleFromTheStraightMotion) {
  RigidOptimizeRequest request = ThroughTheWall(RigidStart::kStraight);
  request.start_noise = 0.02;
  const RigidOptimum found = Optimize({LongBar(), WallWithHole()}, request);
  ExpectFreePath(LongBar(), WallWithHole(), request, found);
  EXPECT_EQ(found.answer.planner, "straight");
  EXPECT_EQ(found.planned_length, 0.0);
  EXPECT_GE(found.rounds, 1);
}

TEST(RigidOptimize, ShortensThePlannersPath) {
  const RigidOptimizeRequest request = ThroughTheWall(RigidStart::kPlanner);
  const RigidWorld world(LongBar(), WallWithHole());
  const RigidOptimum found = Optimize(world, request);
  ExpectFreePath(LongBar(), WallWithHole(), request, found);
  EXPECT_GT(found.planned_length, 0.0);
  EXPECT_LE(found.answer.length, found.planned_length);
  EXPECT_GT(found.answer.length,
            world.Distance(request.task.start, request.task.goal));
}

// One step of a descent, and all of them: what was planned is the least there
// is, and what converged says so.
TEST(RigidOptimize, IsNeverLongerThanThePlanItBeganFrom) {
  const RigidWorld world(LongBar(), WallWithHole());
  RigidOptimizeRequest request = ThroughTheWall(RigidStart::kPlanner);
  int shorter = 0, converged = 0;
  for (const unsigned seed : {11u, 12u, 13u}) {
    request.task.seed = seed;
    const RigidAnswer planned = Plan(world, request.task);
    ASSERT_TRUE(planned.IsSolved()) << planned.reason;
    double before = planned.length;
    for (const int rounds : {1, 100}) {
      request.max_rounds = rounds;
      const RigidOptimum found = Optimize(world, request);
      ExpectFreePath(LongBar(), WallWithHole(), request, found);
      EXPECT_EQ(found.planned_length, planned.length);
      EXPECT_LE(found.answer.length, before);
      EXPECT_LE(found.rounds, rounds);
      EXPECT_EQ(found.answer.status == PathStatus::kSolved,
                found.solver == SolveStatus::kConverged);
      EXPECT_EQ(found.answer.reason.empty(),
                found.answer.status == PathStatus::kSolved);
      before = found.answer.length;
      converged += found.answer.status == PathStatus::kSolved;
    }
    shorter += before < 0.99 * planned.length;
  }
  EXPECT_GE(shorter, 2);
  EXPECT_GE(converged, 1);
}

TEST(RigidOptimize, TrackedRowsLeadThereToo) {
  RigidOptimizeRequest request;
  request.task.start = PoseAt({-3.0, 0.8, 0.0});
  request.task.goal =
      PoseAt({3.0, 0.8, 0.0}, Quaterniond(AngleAxisd(1.0, Vector3d::UnitZ())));
  request.task.time_limit = 300.0;
  request.from = RigidStart::kStraight;
  request.knots = 5;
  request.is_tracked = true;
  const TriangleMesh robot = LongBar(), obstacle = Cube(2.0);
  const RigidOptimum found = Optimize({robot, obstacle}, request);
  ExpectFreePath(robot, obstacle, request, found);
  // Around, not far around.
  EXPECT_LT(found.answer.length,
            1.3 * RigidWorld(robot, obstacle)
                      .Distance(request.task.start, request.task.goal));
}

TEST(RigidOptimize, GoesStraightWhereNothingIsInTheWay) {
  RigidOptimizeRequest request;
  request.task.start = PoseAt({-3.0, 3.0, 0.0});
  request.task.goal = PoseAt({3.0, 3.0, 0.0});
  const RigidOptimum found = Optimize({LongBar(), Cube(1.0)}, request);
  EXPECT_EQ(found.answer.status, PathStatus::kSolved);
  EXPECT_EQ(found.answer.planner, "line");
  EXPECT_EQ(found.answer.path.size(), 2u);
  EXPECT_NEAR(found.answer.length, 6.0, 1e-12);
}

TEST(RigidOptimize, SameRequestSamePath) {
  RigidOptimizeRequest request;
  request.task.start = PoseAt({-3.0, 0.8, 0.0});
  request.task.goal = PoseAt({3.0, 0.8, 0.1});
  request.task.time_limit = 300.0;
  request.from = RigidStart::kStraight;
  request.start_noise = 0.05;
  const RigidWorld world(LongBar(), Cube(2.0));
  const RigidOptimum a = Optimize(world, request);
  const RigidOptimum b = Optimize(world, request);
  ASSERT_FALSE(a.answer.path.empty()) << a.answer.reason;
  ASSERT_EQ(a.answer.path.size(), b.answer.path.size());
  for (std::size_t i = 0; i < a.answer.path.size(); ++i) {
    EXPECT_EQ(a.answer.path[i].position, b.answer.path[i].position);
    EXPECT_EQ(a.answer.path[i].orientation.coeffs(),
              b.answer.path[i].orientation.coeffs());
  }
  EXPECT_EQ(a.iterations, b.iterations);
}

TEST(RigidOptimize, SaysWhatIsNotFreeAndWhatHasNoDepth) {
  RigidOptimizeRequest request = ThroughTheWall(RigidStart::kBoth);
  request.task.start = PoseAt({2.0, 2.0, 0.0});
  EXPECT_EQ(Optimize({LongBar(), WallWithHole()}, request).answer.status,
            PathStatus::kStartInCollision);
  TriangleMesh open = WallWithHole();
  open.triangles.pop_back();
  const RigidOptimum found =
      Optimize({LongBar(), open}, ThroughTheWall(RigidStart::kStraight));
  EXPECT_EQ(found.answer.status, PathStatus::kFailed);
  EXPECT_NE(found.answer.reason.find("no solids"), std::string::npos)
      << found.answer.reason;
  EXPECT_TRUE(found.answer.path.empty());
}

TEST(RigidOptimize, RefusesBadRequests) {
  const RigidWorld world(LongBar(), WallWithHole());
  const auto refused = [&](auto change, const std::string& words) {
    RigidOptimizeRequest request = ThroughTheWall(RigidStart::kBoth);
    change(&request);
    ExpectRefused([&] { Optimize(world, request); }, words);
  };
  refused([](auto* r) { r->knots = 0; }, "knots: expected 1 to 200");
  refused([](auto* r) { r->max_rounds = 0; }, "max_rounds: expected 1 to 100");
  refused([](auto* r) { r->margin = NAN; }, "margin: expected a length");
  refused([](auto* r) { r->start_noise = 2.0; },
          "start_noise: expected a share in [0, 1]");
  refused([](auto* r) { r->task.time_limit = 0.0; }, "time_limit");
  ExpectRefused([] { ParseRigidStart("left", "--start"); },
                "--start: expected both, straight or planner, found 'left'");
}

}  // namespace
}  // namespace phongpd
