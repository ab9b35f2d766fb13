// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: rows summed by hand; torques by PoseRow, whose witnesses are depth's.
#include "results/bench/wrench_measure.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "constraints/pose_row.h"
#include "problems/shapes/shapes.h"
#include "results/bench/contact_points.h"

namespace phongpd::bench {
namespace {

using Eigen::Vector3d;

WrenchSample Sample(const Vector3d& normal, double exit, double depth) {
  WrenchSample sample;
  sample.inside = true;
  sample.normal = normal;
  sample.torque = 0.5 * normal;
  sample.exit = sample.push = exit;
  sample.depth = depth;
  return sample;
}

TEST(WrenchRow, CountsChangesBetweenNeighboursInsideAlone) {
  WrenchRow row;
  Summarize({Sample({1, 0, 0}, 2, 1), Sample({0, 1, 0}, 2, 2), WrenchSample(),
             Sample({0, 0, -1}, 3, 2)},
            &row);
  EXPECT_EQ(row.inside, 3);
  EXPECT_DOUBLE_EQ(row.normal_change, std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(row.torque_change, 0.5 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(row.push_change, 2.0 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(row.exit_mean, (2.0 + 1.0 + 1.5) / 3.0);
  EXPECT_DOUBLE_EQ(row.exit_worst, 2.0);
}

TEST(WrenchCases, HaveTwentyPairsOfDifferentSeedsAndNestedPoses) {
  const std::vector<WrenchPair> pairs = WrenchPairs();
  ASSERT_EQ(pairs.size(), 20u);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].seed, kWrenchSeed + i);
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(pairs[i].name, pairs[k].name);
  }
  for (const WrenchMotion motion :
       {WrenchMotion::kTurn, WrenchMotion::kTurnAndMove}) {
    const auto coarse = WrenchPoses(WrenchPairs(500)[4], motion, 8);
    const auto fine = WrenchPoses(WrenchPairs(500)[4], motion, 16);
    ASSERT_EQ(fine.size(), 17u);
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      EXPECT_EQ(coarse[i].position, fine[2 * i].position);
      EXPECT_EQ(coarse[i].orientation.coeffs(),
                fine[2 * i].orientation.coeffs());
    }
    EXPECT_NEAR(
        coarse.front().orientation.angularDistance(coarse.back().orientation),
        std::acos(0.5), 1e-12);
  }
}

TEST(ContactPoints, GiveTheTorqueThatDepthHasByItsWitness) {
  int compared = 0;
  for (const WrenchPair& pair : WrenchPairs(500)) {
    if (pair.robot.name() == "cross") continue;
    const PoseRow row(pair.robot, pair.obstacle);
    const DepthQuery query(pair.robot, pair.obstacle);
    const ContactPoints points(pair.obstacle.mesh());
    for (const RobotPose& pose : WrenchPoses(pair, WrenchMotion::kTurn, 2)) {
      const PoseRowValue at = row.At(pose);
      if (at.source != RotationSource::kContact) continue;
      const Vector3d out = query.At(pose).contact;
      Vector3d mean;
      ASSERT_TRUE(points.Mean(
          Translated(
              Rotated(pair.robot.mesh(), pose.orientation.toRotationMatrix()),
              out),
          1e-7, &mean));
      EXPECT_LE(((mean - out).cross(at.by_translation) - at.by_rotation).norm(),
                1e-6)
          << pair.name;
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

TEST(ContactPoints, SayWhereNothingTouches) {
  const ContactPoints points(MakeBox({0, 0, 0}, {1, 1, 1}));
  Vector3d mean(7, 7, 7);
  EXPECT_FALSE(points.Mean(MakeBox({0, 0, 1.1}, {1, 1, 2}), 1e-6, &mean));
  EXPECT_EQ(mean, Vector3d(7, 7, 7));
  ASSERT_TRUE(points.Mean(MakeBox({0, 0, 1}, {1, 1, 2}), 1e-6, &mean));
  EXPECT_NEAR((mean - Vector3d(0.5, 0.5, 1)).norm(), 0.0, 1e-12);
}

// A small one of both motions, all metrics and two lengths.
TEST(MeasureWrenches, HasARowAMetricAndALength) {
  const auto rows = MeasureWrenches(WrenchPairs(500)[0], 4, 2);
  ASSERT_EQ(rows.size(), 2u * 6u * 2u);
  for (const WrenchRow& row : rows) {
    EXPECT_EQ(row.inside, row.motion == "turn" ? row.steps + 1 : row.inside);
    EXPECT_GE(row.exit_mean, 1.0 - 1e-9) << row.metric;
    if (row.metric == "euclidean") {
      EXPECT_NEAR(row.exit_worst, 1.0, 1e-9);
    }
  }
}

}  // namespace
}  // namespace phongpd::bench
