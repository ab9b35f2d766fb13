// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: closed forms of places on a circle, samples.
#include "planners/trajectory/joint_turns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/pi.h"
#include "tests/support/curve_problems.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

JointRobot Robot(const Vector3d& start, const Vector3d& goal) {
  JointRobot robot;
  robot.limits = testing::PlainLimits();
  robot.motion = Trajectory({CurvePiece(start, goal, 1.0)});
  return robot;
}

// Of 7 that change places across a circle of radius 5, in any plane: half-way
// they are 2 to the right of its middle, where they were turned by a right
// angle; and they keep their order around it all the time.
TEST(TurnedMotions, KeepTheOrderAroundACircle) {
  constexpr int kCount = 7;
  constexpr double kRadius = 5.0, kLane = 2.0;
  for (const int up : {0, 1, 2}) {
    const auto at = [&](int i, double radius, double turn) {
      const double angle = 2.0 * kPi * i / kCount + turn;
      Vector3d q = Vector3d::Zero();
      q[(up + 1) % 3] = radius * std::cos(angle);
      q[(up + 2) % 3] = radius * std::sin(angle);
      return q;
    };
    std::vector<JointRobot> robots;
    for (int i = 0; i < kCount; ++i) {
      const Vector3d q = at(i, kRadius, 0.3);
      robots.push_back(Robot(q, -q));
    }
    const std::vector<Trajectory> motions = TurnedMotions(robots, kLane);
    ASSERT_EQ(motions.size(), robots.size());
    const double end = motions[0].duration();
    for (int i = 0; i < kCount; ++i) {
      const Vector3d q = at(i, kRadius, 0.3);
      EXPECT_EQ(motions[i].duration(), end);
      EXPECT_EQ(motions[i].At(0.0).position, q);
      EXPECT_EQ(motions[i].At(end).position, -q);
      // To the right of −q is q turned to the left.
      EXPECT_LT(
          (motions[i].At(0.5 * end).position - at(i, kLane, 0.3 + 0.5 * kPi))
              .norm(),
          1e-9);
      EXPECT_LE(BoundLimitUse(motions[i], robots[i].limits).SlowingNeeded(),
                1.0 + 1e-9);
      EXPECT_LT(motions[i].JointGap(2), 1e-9);
      for (int n = 0; n <= 1000; ++n) {
        const Vector3d p = motions[i].At(end * n / 1000).position;
        const Vector3d next =
            motions[(i + 1) % kCount].At(end * n / 1000).position;
        EXPECT_NEAR(next.norm(), p.norm(), 1e-9);
        EXPECT_NEAR((next - p).norm(), 2.0 * std::sin(kPi / kCount) * p.norm(),
                    1e-9);
        EXPECT_GE(p.norm(), 0.99 * kLane);
      }
    }
  }
}

// Who stays does so, and who goes along the axis that nobody is spread along
// goes straight.
TEST(TurnedMotions, LeaveWhoStays) {
  std::vector<JointRobot> robots = {Robot({0, 0, 0}, {4, 0, 0}),
                                    Robot({1, 1, 0}, {1, 1, 0}),
                                    Robot({0, 9, 0}, {0, 9, 0.5})};
  robots[1].stays = true;
  const std::vector<Trajectory> motions = TurnedMotions(robots, 1.0);
  EXPECT_EQ(motions[1].duration(), robots[1].motion.duration());
  EXPECT_EQ(motions[1].At(0.7).position, Vector3d(1, 1, 0));
  for (int n = 0; n <= 100; ++n) {
    const Vector3d q = motions[2].At(motions[2].duration() * n / 100).position;
    EXPECT_EQ(q.head<2>(), Vector3d(0, 9, 0).head<2>());
  }
  EXPECT_NEAR(motions[0].At(0.5 * motions[0].duration()).position.y(), -1.0,
              1e-9);
}

}  // namespace
}  // namespace phongpd::internal
