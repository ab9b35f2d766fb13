// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms, and the original solids at 10⁴ times by exact predicates
// that share nothing with contact spaces.
#include "constraints/moving_judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "constraints/motion_oracle.h"
#include "core/contact/convolution_model.h"
#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;
using testing::Cube;

// Robot: a cube of side 1; in contact with a cube of side 1 at |d|∞ = 1.
MovingBody CubeAlong(const std::string& name, const Trajectory& motion) {
  static const auto space = std::make_shared<const FreeSpace>(
      FreeSpace::OfConvolutions({ConvolutionModel(Cube(1.0), Cube(1.0))}));
  return {name, space, motion};
}

Trajectory Straight(const Vector3d& from, const Vector3d& to, double seconds) {
  return Trajectory({CurvePiece(from, to, seconds)});
}

const FreeSpace& Nothing() {
  static const FreeSpace nothing{std::vector<ContactSpace>()};
  return nothing;
}

TEST(MovingJudge, TellsWhenAndWithWhichBodyTheRobotMeets) {
  // The robot goes along x at speed 1; bodies come down z.
  const Trajectory robot = Straight({0, 0, 0}, {10, 0, 0}, 10.0);
  // Over x = 5 from t = 4: at z = 1 when t = 4.5.
  const MovingBody late =
      CubeAlong("late", Straight({5, 0, 5.5}, {5, 0, -4.5}, 10.0));
  // At x = 8 from the beginning: the robot touches it at t = 7.
  const MovingBody still =
      CubeAlong("still", Straight({8, 0, 0}, {8, 0, 0}, 1.0));
  const MovingCheck one = CheckCurveAmong(Nothing(), {still}, robot);
  EXPECT_EQ(one.verdict, MotionVerdict::kCollides);
  EXPECT_NEAR(one.free_until, 7.0, 1e-6);
  const MovingCheck both = CheckCurveAmong(Nothing(), {still, late}, robot);
  EXPECT_EQ(both.verdict, MotionVerdict::kCollides);
  EXPECT_EQ(both.body, 1);
  EXPECT_NEAR(both.free_until, 4.5, 1e-6);
  EXPECT_NEAR(both.configuration[0], both.time, 1e-9);
  // Begun at 7 on their clock, the falling one is gone.
  EXPECT_EQ(CheckAgainst({late}, robot, 7.0, 10.0).verdict,
            MotionVerdict::kFree);
}

// A cube crosses the way at speed w: the robot, at constant speed v, clears it
// iff it is ahead or behind by so much.
TEST(MovingJudge, AgreesWithTheClosedFormOfTwoCubesThatCross) {
  const double v = 2.0, w = 1.0;
  // Robot at x = v (t − d), body at z = w t − 4: |x| < 1 while |t − d| < 1/v,
  // |z| < 1 while |t − 4| < 1.
  for (double d = 1.0; d < 7.0; d += 0.37) {
    const Trajectory robot =
        Straight({-v * d, 0, 0}, {v * (8.0 - d), 0, 0}, 8.0);
    const MovingBody body =
        CubeAlong("body", Straight({0, 0, -4}, {0, 0, 4 * w}, 8.0));
    const bool is_free = std::abs(d - 4.0) > 1.0 / w + 1.0 / v;
    EXPECT_EQ(CheckCurveAmong(Nothing(), {body}, robot).IsFree(), is_free) << d;
  }
}

// In the body's frame it comes as near as `gap`; to the last digits.
TEST(MovingJudge, ProvesBodiesThatPassWithinABillionth) {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const Trajectory robot = Trajectory(
        {CurvePiece({{-5, 0, 0}, {-1, 0, 0.3}, {1, 0, -0.3}, {5, 0, 0}}, 3.0)});
    // The same way and time, beside it.
    const Vector3d beside(0, 1.0 + gap, 0);
    std::vector<Vector3d> points;
    for (int i = 0; i <= 3; ++i) {
      points.push_back(robot.pieces()[0].point(i) + beside);
    }
    const MovingBody body =
        CubeAlong("body", Trajectory({CurvePiece(points, 3.0)}));
    EXPECT_TRUE(CheckCurveAmong(Nothing(), {body}, robot).IsFree()) << gap;
    const MovingBody touching = CubeAlong(
        "body", Trajectory({CurvePiece({points[0] - gap * Vector3d::UnitY(),
                                        points[1] - gap * Vector3d::UnitY(),
                                        points[2] - gap * Vector3d::UnitY(),
                                        points[3] - gap * Vector3d::UnitY()},
                                       3.0)}));
    EXPECT_FALSE(CheckCurveAmong(Nothing(), {touching}, robot).IsFree()) << gap;
  }
}

TEST(MovingJudge, LooksAtTheRestOfTheRobotToo) {
  const Trajectory robot = Straight({0, 0, 0}, {1, 0, 0}, 1.0);
  const MovingBody sweeps =
      CubeAlong("sweeps", Straight({1, 0, -10}, {1, 0, 10}, 20.0));
  const MovingCheck check = CheckCurveAmong(Nothing(), {sweeps}, robot);
  EXPECT_EQ(check.verdict, MotionVerdict::kCollides);
  EXPECT_NEAR(check.free_until, 9.0, 1e-6);
  EXPECT_EQ(check.configuration, Vector3d(1, 0, 0));
}

TEST(MovingJudge, FixedThingsComeFirstWhereTheyAreMetFirst) {
  const FreeSpace box(std::vector<ContactSpace>{},
                      {Vector3d::Constant(-3), Vector3d::Constant(3)});
  const Trajectory robot = Straight({0, 0, 0}, {10, 0, 0}, 10.0);
  const MovingBody later =
      CubeAlong("later", Straight({6, 0, 0}, {6, 0, 0}, 1));
  const MovingBody sooner =
      CubeAlong("sooner", Straight({3, 0, 0}, {3, 0, 0}, 1));
  const MovingCheck fixed = CheckCurveAmong(box, {later}, robot);
  EXPECT_EQ(fixed.body, MovingCheck::kFixed);
  EXPECT_NEAR(fixed.time, 3.0, 1e-9);
  EXPECT_EQ(CheckCurveAmong(box, {later, sooner}, robot).body, 1);
}

// Random curves among random moving voxel solids: not one hit where it says
// free, and a hit where it says so.
TEST(MovingJudge, IsRightOfRandomMotionsAtTenThousandTimes) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  const auto point = [&]() -> Vector3d {
    return 2.2 * Vector3d(normal(random), normal(random), normal(random));
  };
  const auto motion = [&](int pieces) {
    std::vector<CurvePiece> all;
    Vector3d at = point();
    for (int i = 0; i < pieces; ++i) {
      std::vector<Vector3d> points = {at};
      for (int k = 0; k < 5; ++k) points.push_back(point());
      at = points.back();
      all.emplace_back(points, std::exp(0.5 * normal(random)));
    }
    return Trajectory(std::move(all));
  };
  int free = 0, collides = 0;
  const Solid robot = MakeSolid(Cube(0.7), "robot");
  const Solid solid =
      MakeSolid(MakeBox({-0.5, -0.1, -0.3}, {0.5, 0.2, 0.4}), "bar");
  const auto space = std::make_shared<const FreeSpace>(
      FreeSpace::OfConvolutions({ConvolutionModel(robot, solid)}));
  const MotionOracle oracle(robot, solid);
  for (int i = 0; i < 40; ++i) {
    const Trajectory curve = motion(1 + i % 3);
    const MovingBody body = {"bar", space, motion(1 + i % 2)};
    const MovingCheck check = CheckCurveAmong(Nothing(), {body}, curve);
    ASSERT_NE(check.verdict, MotionVerdict::kUndecided);
    const double end = check.IsFree()
                           ? std::max(curve.duration(), body.motion.duration())
                           : check.free_until;
    free += check.IsFree();
    collides += !check.IsFree();
    int hits = 0;
    for (int k = 0; k < 10000; ++k) {
      const double t = end * (k + 0.5) / 10000;
      hits +=
          oracle.Collides(curve.At(t).position - body.motion.At(t).position);
    }
    EXPECT_EQ(hits, 0) << i;
    if (check.IsFree()) continue;
    const Vector3d there =
        curve.At(check.time).position - body.motion.At(check.time).position;
    // Where it only touches, a little further in.
    EXPECT_TRUE(oracle.Collides(there) || !space->IsFree(there) ||
                space->Clearance(there) < 1e-9)
        << i;
  }
  EXPECT_GE(free, 5);
  EXPECT_GE(collides, 5);
}

TEST(MovingJudge, OfNothingSaysWhatTheJudgeOfCurvesSays) {
  const Trajectory robot = Straight({0, 0, 0}, {1, 0, 0}, 1.0);
  EXPECT_TRUE(CheckCurveAmong(Nothing(), {}, robot).IsFree());
  EXPECT_FALSE(CheckCurveAmong(Nothing(), {}, Trajectory()).IsFree());
  EXPECT_EQ(LastMotion({}), 0.0);
  EXPECT_THROW(
      CheckCurveAmong(Nothing(), {CubeAlong("none", Trajectory())}, robot),
      InputError);
}

}  // namespace
}  // namespace phongpd
