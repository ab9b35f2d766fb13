// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the exponential of a matrix by its series, and closed forms.
#include "constraints/rigid/rigid_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/pi.h"
#include "tests/support/expect_refused.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::ExpectRefused;
using testing::RandomRotation;
using LongMatrix = Eigen::Matrix<long double, 3, 3>;

// exp([v]) by its series, after 2^20 halvings, squared as often.
Matrix3d ExponentialOf(const Vector3d& v) {
  LongMatrix cross;
  const Eigen::Matrix<long double, 3, 1> w = v.cast<long double>();
  cross << 0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0;
  cross *= 0x1p-10L;
  LongMatrix sum = LongMatrix::Identity(), term = sum;
  for (int i = 1; i < 20; ++i) {
    term = term * cross / static_cast<long double>(i);
    sum += term;
  }
  for (int i = 0; i < 10; ++i) sum = sum * sum;
  return sum.cast<double>();
}

RobotPose RandomPose(std::mt19937_64* random) {
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  RobotPose pose;
  pose.position = {place(*random), place(*random), place(*random)};
  pose.orientation = Quaterniond(RandomRotation(random));
  return pose;
}

RobotPose Turned(const Vector3d& axis, double angle) {
  RobotPose pose;
  pose.orientation = Eigen::AngleAxisd(angle, axis.normalized());
  return pose;
}

TEST(RigidMotion, IsTheExponentialOfItsTurn) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 300; ++i) {
    const RobotPose a = RandomPose(&random), b = RandomPose(&random);
    const RigidMotion motion(a, b);
    EXPECT_LE(motion.angle(), kPi + 1e-14);
    EXPECT_NEAR(motion.turn().norm(), motion.angle(), 1e-14);
    EXPECT_NEAR((motion.angle() * motion.axis() - motion.turn()).norm(), 0.0,
                1e-14);
    for (const double t : {0.0, 0.125, 0.3, 0.77, 1.0}) {
      const RobotPose at = motion.At(t);
      const Matrix3d expected =
          ExponentialOf(t * motion.turn()) * a.orientation.toRotationMatrix();
      EXPECT_LE((at.orientation.toRotationMatrix() - expected).norm(), 1e-14);
      EXPECT_LE(
          (at.position - (a.position + t * (b.position - a.position))).norm(),
          1e-14);
    }
    EXPECT_LE((motion.At(1.0).orientation.toRotationMatrix() -
               b.orientation.toRotationMatrix())
                  .norm(),
              1e-14);
    EXPECT_EQ(motion.At(1.0).position, b.position);
  }
}

TEST(RigidMotion, TurnsTheShorterWay) {
  const Vector3d up = Vector3d::UnitZ();
  for (const double angle : {1e-300, 1e-16, 1e-9, 0.5, 3.0, kPi - 1e-9}) {
    const RigidMotion motion(Turned(up, 0.0), Turned(up, angle));
    EXPECT_NEAR(motion.turn()[2], angle, 1e-15 * angle + 1e-300) << angle;
  }
  const RigidMotion back(Turned(up, 0.0), Turned(up, kPi + 0.1));
  EXPECT_NEAR(back.turn()[2], 0.1 - kPi, 1e-14);
}

TEST(RigidMotion, TakesAStatedAxisForHalfATurn) {
  const Vector3d axes[] = {{1, 2, 3}, {0, 1, -1}, {0, 0, 1}, {1, -2, 0}};
  for (const Vector3d& axis : axes) {
    for (const double sign : {1.0, -1.0}) {
      RobotPose end;
      end.orientation.w() = sign * 1e-17;
      end.orientation.vec() = sign * axis.normalized();
      const RigidMotion motion(RobotPose(), end);
      EXPECT_LE((motion.axis() - axis.normalized()).norm(), 1e-15);
      EXPECT_NEAR(motion.angle(), kPi, 1e-15);
    }
  }
}

TEST(RigidMotion, DoesNotTurnBetweenEqualOrientations) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const RobotPose a = RandomPose(&random);
    RobotPose b = RandomPose(&random);
    for (const double sign : {1.0, -1.0}) {
      b.orientation.coeffs() = sign * a.orientation.coeffs();
      const RigidMotion motion(a, b);
      EXPECT_EQ(motion.angle(), 0.0);
      EXPECT_EQ(motion.turn(), Vector3d::Zero());
      EXPECT_TRUE(motion.At(0.4).orientation.coeffs().allFinite());
    }
  }
}

TEST(RigidMotion, TurnsAsFarAsItIsTold) {
  std::mt19937_64 random(3);
  const RobotPose a = RandomPose(&random);
  const Vector3d axis = Vector3d(1.0, -2.0, 0.5).normalized();
  const RigidMotion twice =
      RigidMotion::Turning(a, {1.0, 2.0, 3.0}, 4.0 * kPi * axis);
  EXPECT_NEAR(twice.angle(), 4.0 * kPi, 1e-14);
  EXPECT_LE((twice.At(1.0).orientation.toRotationMatrix() -
             a.orientation.toRotationMatrix())
                .norm(),
            1e-14);
  EXPECT_LE((twice.At(0.125).orientation.toRotationMatrix() -
             ExponentialOf(0.5 * kPi * axis) * a.orientation.toRotationMatrix())
                .norm(),
            1e-14);
  EXPECT_EQ(twice.end().position, Vector3d(1.0, 2.0, 3.0));
}

TEST(RigidMotion, RefusesWhatIsNoPose) {
  RobotPose bad;
  bad.orientation.w() = 1.01;
  ExpectRefused([&] { RigidMotion(RobotPose(), bad); },
                "rigid motion: end: expected a unit quaternion (to 1e-9), "
                "found length 1.01");
  bad = RobotPose();
  bad.position[1] = std::numeric_limits<double>::quiet_NaN();
  ExpectRefused([&] { RigidMotion(bad, RobotPose()); },
                "rigid motion: start: expected a finite pose");
  ExpectRefused(
      [&] {
        RigidMotion::Turning(RobotPose(), Vector3d::Zero(),
                             Vector3d(0.0, 2e3, 0.0));
      },
      "at most 1e+03 rad, found 2e+03");
  const double infinity = std::numeric_limits<double>::infinity();
  ExpectRefused(
      [&] {
        RigidMotion::Turning(RobotPose(), Vector3d::Zero(),
                             Vector3d(0.0, infinity, 0.0));
      },
      "finite end and turn");
}

TEST(RigidMotion, RefusesMatricesThatAreNoRotation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() *= 1.0 + 1e-6;
  ExpectRefused([&] { PoseOf(pose, "pose 3"); },
                "pose 3: expected a rotation, RᵀR = 1 to 1e-9, found 2e-06");
  pose.linear() = -Matrix3d::Identity();
  ExpectRefused([&] { PoseOf(pose, "pose 3"); }, "found a reflection");
  pose.linear()(1, 2) = std::numeric_limits<double>::infinity();
  ExpectRefused([&] { PoseOf(pose, "pose 3"); }, "expected a finite pose");
  std::mt19937_64 random(4);
  for (int i = 0; i < 100; ++i) {
    pose.linear() = RandomRotation(&random);
    const RobotPose read = PoseOf(pose, "pose");
    EXPECT_LE((read.orientation.toRotationMatrix() - pose.linear()).norm(),
              1e-14);
  }
}

}  // namespace
}  // namespace phongpd
