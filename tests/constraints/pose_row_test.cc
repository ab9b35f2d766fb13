// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: differences of whole answers; a box that turns, in closed form.
#include "constraints/pose_row.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/mesh/mesh_error.h"
#include "problems/shapes/shapes.h"
#include "tests/support/solid_tools.h"

namespace phongpd {
namespace {

using Eigen::AngleAxisd, Eigen::Quaterniond, Eigen::Vector3d;

// The pose a small step on: moved along axis k, or turned about it (k ≥ 3).
RobotPose Stepped(const RobotPose& pose, int k, double step) {
  RobotPose next = pose;
  if (k < 3) {
    next.position[k] += step;
  } else {
    next.orientation =
        AngleAxisd(step, Vector3d::Unit(k - 3)) * pose.orientation;
  }
  return next;
}

struct RowTally {
  int smooth = 0, kinks = 0, differences = 0;
};

// Compares with differences of the values of `row` at random poses.  Where the
// two one-sided differences disagree there is a kink between them, and the
// derivative must be that of one side, or between.
RowTally CompareWithDifferences(const TriangleMesh& robot,
                                const TriangleMesh& obstacle, int poses,
                                unsigned seed) {
  const PoseRow row(MakeSolid(robot, "robot"), MakeSolid(obstacle, "obstacle"));
  const double size = ComputeBounds(robot).Diagonal();
  const BoundingBox box = ComputeBounds(obstacle);
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-0.2, 1.2);
  std::normal_distribution<double> normal;
  RowTally tally;
  for (int i = 0; i < poses; ++i) {
    RobotPose pose;
    for (int k = 0; k < 3; ++k) {
      pose.position[k] =
          box.min[k] + uniform(engine) * (box.max[k] - box.min[k]);
    }
    const double w = normal(engine), x = normal(engine), y = normal(engine),
                 z = normal(engine);
    pose.orientation = Quaterniond(w, x, y, z).normalized();
    const PoseRowValue at = row.At(pose);
    EXPECT_TRUE(at.certified);
    tally.differences += at.source == RotationSource::kDifferences;
    for (int k = 0; k < 6; ++k) {
      const double unit = k < 3 ? size : 1.0;
      const double h = 1e-5 * unit;
      const double slope = k < 3 ? at.by_translation[k] : at.by_rotation[k - 3];
      const double up = (row.At(Stepped(pose, k, h)).value - at.value) / h;
      const double down = (at.value - row.At(Stepped(pose, k, -h)).value) / h;
      const double scale = k < 3 ? 1.0 : size;
      if (std::abs(up - down) < 1e-4 * scale) {
        ++tally.smooth;
        EXPECT_NEAR(slope, 0.5 * (up + down), 1e-4 * scale)
            << "pose " << i << ", direction " << k << ", value " << at.value;
      } else {
        ++tally.kinks;
      }
    }
  }
  return tally;
}

TEST(PoseRow, DerivativesAreThoseOfWholeAnswers) {
  const TriangleMesh box = MakeBox({-0.5, -0.2, -0.1}, {0.5, 0.2, 0.1});
  const RowTally convex =
      CompareWithDifferences(box, MakeIcoBall(1.0, 1), 20, 1);
  EXPECT_GE(convex.smooth, 100);
  EXPECT_EQ(convex.differences, 0);  // a convex C_cont has no reflex edge
  const RowTally star =
      CompareWithDifferences(box, MakeU(2.0, 0.25, 0.5), 40, 2);
  EXPECT_GE(star.smooth, 200);
}

// In the corner of an L the free corner is nearest: two contacts at once.
TEST(PoseRow, SeveralContactsAtOnceAreToldAndRight) {
  const TriangleMesh l = MakeL(2.0, 0.7, 1.0);
  const RowTally tally = CompareWithDifferences(
      MakeBox({-0.6, -0.6, -0.3}, {0.6, 0.6, 0.3}), l, 40, 3);
  EXPECT_GE(tally.smooth, 150);
  EXPECT_GE(tally.differences, 1);
}

// A bar over a slab: its lowest corner is at z − sin|θ|·½ − cos θ·0.1.
TEST(PoseRow, OfABarOverASlabIsItsLowestCorner) {
  const PoseRow row(
      MakeSolid(MakeBox({-0.5, -0.1, -0.1}, {0.5, 0.1, 0.1}), "bar"),
      MakeSolid(MakeBox({-9, -9, -1}, {9, 9, 0}), "slab"));
  for (const double height : {0.8, 0.3, 0.05}) {
    for (const double angle : {-0.6, -0.1, 0.2, 0.9}) {
      const RobotPose pose = {
          {0.1, 0.2, height},
          Quaterniond(AngleAxisd(angle, Vector3d::UnitY()))};
      const double s = std::sin(std::abs(angle)), c = std::cos(angle);
      const PoseRowValue at = row.At(pose);
      EXPECT_NEAR(at.value, height - 0.5 * s - 0.1 * c, 1e-10);
      EXPECT_NEAR(at.by_translation.z(), 1.0, 1e-12);
      EXPECT_NEAR(at.by_rotation.y(),
                  -std::copysign(0.5 * c, angle) + 0.1 * std::sin(angle), 1e-9);
      EXPECT_EQ(at.status, at.value < 0.0 ? DepthStatus::kPenetrating
                                          : DepthStatus::kSeparate);
      EXPECT_EQ(at.source, RotationSource::kContact);
    }
  }
}

TEST(PoseRow, RefusesPosesThatAreNone) {
  const Solid box = MakeSolid(MakeBox({0, 0, 0}, {1, 1, 1}), "box");
  const PoseRow row(box, box);
  EXPECT_THROW(row.At({Vector3d::Constant(NAN), Quaterniond::Identity()}),
               InputError);
  EXPECT_THROW(row.At({Vector3d::Zero(), Quaterniond(1, 1, 0, 0)}), InputError);
}

}  // namespace
}  // namespace phongpd
