// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: a plate, where it is known by hand what any rule can do; followers
// made up to jump in one way or the other.
#include "results/bench/yardstick.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/projection/euclidean_metric.h"
#include "problems/shapes/shapes.h"
#include "results/bench/jump_classes.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

// From half-way behind one face of a plate of thickness 2 to half-way behind
// the other: whoever stays with the first face is 1.5 deep at the end, where
// the Euclidean depth is 0.5.
TEST(Yardstick, OfAPlateIsOneJumpUnlessThreeTimesTheDepthIsAllowed) {
  const ContactSpace plate =
      TakeAsContactSpace(MakeBox({-1, -3, -3}, {1, 3, 3}));
  Motion motion;
  for (int i = 0; i <= 400; ++i) motion.push_back({-0.5 + i / 400.0, 0.1, 0.2});
  const std::vector<double> depths =
      EuclideanDepths(EuclideanMetric(plate), motion);
  EXPECT_EQ(Yardstick(plate).LeastJumps(motion, depths, {1.01, 1.5, 2.5, 3.1}),
            (std::vector<int>{1, 1, 1, 0}));
}

// Near an edge the way round it is in reach: the plate's rim is not far.
TEST(Yardstick, NeedsNoJumpWhereAWayRoundIsInReach) {
  const ContactSpace plate =
      TakeAsContactSpace(MakeBox({-1, -3, -3}, {1, 3, 3}));
  Motion motion;
  for (int i = 0; i <= 400; ++i) motion.push_back({-0.5 + i / 400.0, 0.1, 2.5});
  const std::vector<double> depths =
      EuclideanDepths(EuclideanMetric(plate), motion);
  EXPECT_EQ(Yardstick(plate).LeastJumps(motion, depths, {2.5}),
            (std::vector<int>{0}));
}

// A follower that answers a function of x.
template <typename Function>
Follower Answer(const Function& pd) {
  return [pd](const Vector3d& q) {
    return MotionStep{Vector3d(pd(q.x()), 0, 0), false, false, false};
  };
}

TEST(JumpClass, TellsFoldsFromSteepChangesAndBugs) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), pd(1, 0, 0);
  const auto class_of = [&](const Follower& follow, bool has_branches) {
    return ClassOfJump(follow, a, b, pd, 0.5, has_branches);
  };
  const auto flips = [](double x) { return x < 0.3 ? 1.0 : 2.0; };
  EXPECT_EQ(class_of(Answer(flips), false), JumpClass::kFold);
  // A metric with branches would have said so.
  EXPECT_EQ(class_of(Answer(flips), true), JumpClass::kBug);
  EXPECT_EQ(class_of(
                [](const Vector3d& q) {
                  const bool is_over = q.x() >= 0.3;
                  return MotionStep{Vector3d(is_over ? 2 : 1, 0, 0), false,
                                    false, is_over};
                },
                true),
            JumpClass::kFold);
  EXPECT_EQ(class_of(Answer([](double x) {
                       return 1.5 + 0.5 * std::tanh(100.0 * (x - 0.3));
                     }),
                     true),
            JumpClass::kSteep);
  EXPECT_EQ(
      class_of(Answer([](double x) { return x < 0.3 ? 1.0 : 0.0; }), true),
      JumpClass::kElsewhere);
}

}  // namespace
}  // namespace phongpd::bench
