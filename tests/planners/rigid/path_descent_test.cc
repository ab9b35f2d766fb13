// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: gaps and lengths in closed form; differences of gaps; the judge asked
// again; a search over nothing but the sides of a box.
#include "planners/rigid/optimizer/path_descent.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/pi.h"
#include "planners/rigid/object_norm.h"
#include "planners/rigid/optimizer/feature_contacts.h"
#include "planners/rigid/optimizer/linear_step.h"
#include "planners/rigid/rigid_world.h"
#include "problems/shapes/shapes.h"

namespace phongpd::internal {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d, Eigen::VectorXd;
using RigidPath = std::vector<RobotPose>;

RobotPose At(const Vector3d& position, double angle = 0.0,
             const Vector3d& axis = Vector3d::UnitZ()) {
  RobotPose pose;
  pose.position = position;
  pose.orientation = Quaterniond(AngleAxisd(angle, axis.normalized()));
  return pose;
}

TriangleMesh Cube(double half) {
  return MakeBox(Vector3d::Constant(-half), Vector3d::Constant(half));
}

// A small cube, and a tall pillar around whose edge it goes.
const RigidWorld& Pillar() {
  static const RigidWorld world(Cube(0.1),
                                MakeBox({-1.0, -1.0, -9.0}, {1.0, 1.0, 9.0}));
  return world;
}

PathDescentTask Task(const RigidWorld& world) {
  PathDescentTask task;
  task.bounds = {Vector3d::Constant(-5.0), Vector3d::Constant(5.0)};
  task.margin = 1e-3 * world.reach();
  return task;
}

double LengthOf(const RigidWorld& world, const RigidPath& path) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    length += world.Distance(path[i], path[i + 1]);
  }
  return length;
}

bool IsFree(const RigidWorld& world, const RigidPath& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (!world.judge().Check(RigidMotion(path[i], path[i + 1])).IsFree()) {
      return false;
    }
  }
  return true;
}

// A detour around the edge at (1, 1) of the pillar.
RigidPath Detour(double corner) {
  return {At({0.0, 1.5, 0.0}), At({0.7, 1.9, 0.1}), At({corner, corner, 0}),
          At({1.9, 0.7, 0.1}, 0), At({1.5, 0.0, 0.0})};
}

TEST(FeatureContacts, AFaceAlongAFaceIsCloseAtAllItsCorners) {
  const RigidModel& model = Pillar().model();
  const FeatureContacts features(model.robot_surface, model.obstacle_surface);
  std::vector<PoseContact> contacts;
  long tests = 0;
  for (const double x : {-0.5, 0.0, 0.33}) {  // on a crease of the face, too
    const RobotPose pose = At({1.15, x, 1.0});
    features.Find(pose, 0.1, &contacts, &tests);
    int corners = 0;
    for (const PoseContact& contact : contacts) {
      EXPECT_NEAR(contact.gap, 0.05, 1e-12);
      EXPECT_LT((contact.normal - Vector3d::UnitX()).norm(), 1e-12);
      corners += std::abs(std::abs(contact.arm.y()) - 0.1) < 1e-12 &&
                 std::abs(std::abs(contact.arm.z()) - 0.1) < 1e-12;
    }
    EXPECT_EQ(corners, 4) << x;
  }
  EXPECT_GT(tests, 0);
}

// Fine surfaces have more pairs than a time limit waits for.
TEST(FeatureContacts, EndWhenTheSearchIsStopped) {
  const RigidWorld world(MakeIcoBall(0.5, 4), Cube(1.0));
  const FeatureContacts features(world.model().robot_surface,
                                 world.model().obstacle_surface);
  std::vector<PoseContact> contacts;
  RigidStop stop(100.0, [] { return true; });
  long all = 0, until_stopped = 0;
  EXPECT_TRUE(features.Find(At({1.6, 0.0, 0.0}), 2.0, &contacts, &all));
  EXPECT_FALSE(features.Find(At({1.6, 0.0, 0.0}), 2.0, &contacts,
                             &until_stopped, &stop));
  EXPECT_GT(all, 30'000);
  EXPECT_LT(until_stopped, 10'000);
}

TEST(FeatureContacts, ChangeAsTheirNormalsAndArmsSay) {
  const RigidModel& model = Pillar().model();
  const FeatureContacts features(model.robot_surface, model.obstacle_surface);
  std::vector<PoseContact> contacts;
  long tests = 0;
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 12; ++k) {
    // A corner before a face, two edges that cross, past the pillar's edge.
    const RobotPose pose = At({1.2 - 0.002 * k, 0.2 * (k % 6), 0.3},
                              0.3 + 0.2 * k, Vector3d(0.3, 0.5 + 0.1 * k, 1.0));
    features.Find(pose, 0.3, &contacts, &tests);
    ASSERT_FALSE(contacts.empty()) << k;
    const PoseContact nearest = contacts.front();
    EXPECT_NEAR(
        nearest.gap,
        Pillar().judge().Clearance(RigidMotion(pose, pose), {1e-9, 0}).upper,
        1e-8);
    for (int c = 0; c < 6; ++c) {
      Vector6 move = Vector6::Zero();
      move[c] = kStep;
      double gap[2];
      for (const int side : {0, 1}) {
        features.Find(Moved(pose, (2 * side - 1) * move, 1.0), 0.3, &contacts,
                      &tests);
        gap[side] = contacts.front().gap;
      }
      const double slope =
          c < 3 ? nearest.normal[c] : nearest.arm.cross(nearest.normal)[c - 3];
      EXPECT_NEAR((gap[1] - gap[0]) / (2 * kStep), slope, 1e-5)
          << k << ", " << c;
    }
  }
}

TEST(LinearStep, KeepsWhatIsCloseAndItsGradientIsADifference) {
  const RigidWorld& world = Pillar();
  const RigidPath path = Detour(1.11);
  const PoseChart chart(path, world.reach(), world.gyration());
  const FeatureContacts features(world.model().robot_surface,
                                 world.model().obstacle_surface);
  std::vector<PathContacts> places = {{1, 1.0, {}}};
  long tests = 0;
  features.Find(path[2], 0.2, &places[0].contacts, &tests);
  ASSERT_FALSE(places[0].contacts.empty());
  // Twice: where the margin is kept, and where the place lacks some of it.
  for (const double margin : {1e-3, 0.1}) {
    LinearStep step(chart, places, Task(world).bounds, margin, 0.05);
    const int n = step.variables();
    EXPECT_EQ(n, chart.variables() + (margin > 0.01 ? 1 : 0));
    VectorXd x = VectorXd::Constant(n, 0.01), gradient(n);
    step.ObjectiveGradient(x.data(), gradient.data());
    for (int i = 0; i < n; ++i) {
      VectorXd a = x, b = x;
      a[i] -= 1e-5;
      b[i] += 1e-5;
      EXPECT_NEAR((step.Objective(b.data()) - step.Objective(a.data())) / 2e-5,
                  gradient[i], 1e-7);
    }
    const VectorXd zero = VectorXd::Zero(n);
    VectorXd values(step.rows()), x_low(n), x_high(n), low(step.rows()),
        high(step.rows());
    step.Bounds(x_low.data(), x_high.data(), low.data(), high.data());
    ASSERT_TRUE(step.Constraints(zero.data(), values.data(), nullptr));
    EXPECT_TRUE((values.array() >= low.array()).all());
    const IpoptRun run = SolveWithIpopt(&step, zero, IpoptSettings());
    ASSERT_EQ(run.status, SolveStatus::kConverged) << run.raw_status;
    std::vector<PoseContact> after;
    features.Find(chart.Poses(run.x.data())[2], 0.2, &after, &tests);
    // To second order in a step of 0.05.
    if (margin > 0.01) {
      EXPECT_GT(after.front().gap, places[0].contacts.front().gap + 0.02);
    } else {
      EXPECT_GT(after.front().gap, -2e-3);
    }
  }
}

TEST(DescendPath, IsStraightWhereNothingIsInTheWay) {
  const RigidWorld& world = Pillar();
  RigidStop stop(100.0, {});
  const RigidPath start = {At({2.0, -2.0, 0.0}), At({2.8, -1.0, 0.5}, 0.7),
                           At({2.5, 1.0, -0.4}, -0.3), At({2.0, 2.0, 0.0})};
  const PathDescentEnd end =
      DescendPath(world.model(), start, Task(world), &stop);
  EXPECT_EQ(end.status, SolveStatus::kConverged);
  EXPECT_NEAR(end.length, 4.0, 4e-3);
  EXPECT_GE(end.steps, 1);
}

// The cube's centre stays 0.1 away from the pillar at least: around its edge,
// rounded by that; and it need not turn: around the edge of the box grown by
// 0.1.
TEST(DescendPath, GoesRoundAnEdgeWithinTheBoundsOfGeometry) {
  const RigidWorld& world = Pillar();
  const RigidPath start = Detour(1.4);
  ASSERT_TRUE(IsFree(world, start));
  RigidStop stop(100.0, {});
  const PathDescentEnd end =
      DescendPath(world.model(), start, Task(world), &stop);
  const double most = 2 * std::hypot(1.1, 0.4);
  // From (0, 1.5) to the circle about (1, 1) and along it to the diagonal.
  const double away = std::hypot(1.0, 0.5),
               tangent = std::sqrt(away * away - 0.01);
  const double turn =
      0.75 * kPi - std::atan2(1.0, 0.5) - 0.5 * kPi + std::asin(0.1 / away);
  const double least = 2 * (tangent + 0.1 * std::max(0.0, turn));
  EXPECT_LT(least, most);
  EXPECT_GT(end.length, least - 1e-9);
  EXPECT_LT(end.length, 1.005 * most);
  EXPECT_NEAR(end.length, LengthOf(world, end.path), 1e-12);
  EXPECT_TRUE(IsFree(world, end.path));
  EXPECT_EQ(end.path.front().position, start.front().position);
  EXPECT_EQ(end.path.back().position, start.back().position);
}

// A start as close as planners leave it, closer than the margin; and one that
// is ended at any moment.
TEST(DescendPath, IsProvedAndNoLongerWheneverItEnds) {
  const RigidWorld& world = Pillar();
  const RigidPath start = Detour(1.1 + 1e-7);
  ASSERT_TRUE(IsFree(world, start));
  const double before = LengthOf(world, start);
  double last = before;
  int calls = 0;
  for (const int most : {0, 3, 10, 40, 100000}) {
    calls = 0;
    RigidStop stop(100.0, [&] { return ++calls > most; });
    const PathDescentEnd end =
        DescendPath(world.model(), start, Task(world), &stop);
    EXPECT_TRUE(IsFree(world, end.path)) << most;
    EXPECT_LE(end.length, last) << most;
    EXPECT_EQ(end.status == SolveStatus::kCancelled, calls > most);
    last = end.length;
  }
  EXPECT_LT(last, before - 0.05);
}

// Along a face, closer to it than the margin: what gives room is longer than
// the straight line, which is answered and did not converge.
TEST(DescendPath, SaysOfNoOtherPathThanTheAnswerThatItConverged) {
  const RigidWorld& world = Pillar();
  const RigidPath start = {At({1.1001, -0.5, 0.0}), At({1.1001, 0.0, 0.0}),
                           At({1.1001, 0.5, 0.0})};
  PathDescentTask task = Task(world);
  task.margin = 0.05;
  RigidStop stop(100.0, {});
  const PathDescentEnd end = DescendPath(world.model(), start, task, &stop);
  EXPECT_GE(end.steps, 1);
  EXPECT_NEAR(end.length, 1.0, 1e-12);
  EXPECT_EQ(end.path[1].position, start[1].position);
  EXPECT_EQ(end.status, SolveStatus::kStalledFeasible);
}

}  // namespace
}  // namespace phongpd::internal
