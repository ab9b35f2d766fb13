// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: gaps of cubes by hand, before and after times were changed.
#include "planners/trajectory/joint_bodies.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "planners/world/moving_obstacle.h"
#include "planners/world/world.h"
#include "tests/support/curve_problems.h"
#include "tests/support/solid_tools.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;

constexpr double kTrust = 0.5;

// A cube of side 1 on its way, and one that passes at a distance.
KnotCurve Curve() {
  return StopAtCorners({{0, 0, 0}, {4, 1, 0}}, testing::PlainLimits(), 4);
}

MovingBody Body(const std::vector<CurvePiece>& pieces) {
  Workspace workspace;
  workspace.robot = MakeSolid(testing::Cube(1.0), "robot");
  workspace.bounds = {{-9, -9, -9}, {9, 9, 9}};
  return MovingBodies(World(workspace), {{MakeSolid(testing::Cube(1.0), "body"),
                                          Trajectory(pieces)}})
      .front();
}

// What a row says where points stay and times change.
double ValueOf(const JointProgram::Row& row, double eta, double theta,
               double t) {
  return row.constant + row.eta * eta + row.theta * theta + row.t * t;
}

// Of a body of constant speed rows are exact: by what it is nearer, or farther,
// at the times to which these change.
TEST(JointBodies, KnowsWhatItCostsToBeThereSooner) {
  const Vector3d velocity(0.3, -0.4, 0);
  const KnotCurve curve = Curve();
  const double total = curve.Duration();
  const Vector3d from(2, 3, 0);
  const MovingBody body =
      Body({CurvePiece(from, from + 2.0 * total * velocity, 2.0 * total)});
  const double margin = 10.0;  // all rows
  const auto rows = RowsAgainst(body, curve, 0, kTrust, margin, true);
  ASSERT_GT(rows.size(), 20u);
  int moved = 0;
  for (const JointProgram::Row& row : rows) {
    EXPECT_LT(row.constant, 0.0);
    EXPECT_NEAR(row.weight.sum(), 1.0, 1e-12);
    double s = 0.0, begin = 0.0;
    for (int j = 0; j < 6; ++j) s += row.weight[j] * j / 5.0;
    for (int i = 0; i < row.piece; ++i) begin += curve.durations[i];
    const double h = curve.durations[row.piece];
    for (const auto& [eta, theta, t] :
         {std::array<double, 3>{0.1, 0, 0}, {0, 0.02, 0}, {0, 0, -0.05}}) {
      const double now = begin + s * h;
      const double then =
          now + s * h * eta + theta * total / curve.pieces() + t * now;
      // The body comes nearer by as much as it goes towards the robot.
      const Vector3d gone = (then - now) * velocity;
      EXPECT_NEAR(ValueOf(row, eta, theta, t) - row.constant,
                  -row.direction.dot(gone) / kTrust, 1e-9);
      moved += std::abs(row.direction.dot(gone)) > 1e-3;
    }
  }
  EXPECT_GT(moved, 20);
  for (const auto& row : RowsAgainst(body, curve, 0, kTrust, margin, false)) {
    EXPECT_EQ(row.t, 0.0);
  }
  EXPECT_NEAR(LargestSpeed({body}), 0.5, 1e-12);
}

// Where a body's pieces end, a piece of the curve is parted: gaps are those to
// where the body is, on both sides, and after it has come to rest.
TEST(JointBodies, FollowsABodyFromPieceToPiece) {
  const KnotCurve curve = Curve();
  const double total = curve.Duration();
  const MovingBody body =
      Body({CurvePiece({2, 4, 0}, {2, 3, 0}, 0.3 * total),
            CurvePiece({2, 3, 0}, {5, 3.5, 0}, 0.35 * total)});
  int rows = 0;
  for (const auto& row : RowsAgainst(body, curve, 0, kTrust, 10.0, true)) {
    double begin = 0.0;
    for (int i = 0; i < row.piece; ++i) begin += curve.durations[i];
    // The row's point, and that of the body in the same time; straight.
    const Vector3d q = curve.PointsOf(row.piece) * row.weight;
    double s = 0.0;
    for (int j = 0; j < 6; ++j) s += row.weight[j] * j / 5.0;
    const double time = begin + s * curve.durations[row.piece];
    const Vector3d p = body.motion.At(time).position;
    // No plane between two is farther than they are.
    const double apart =
        ((q - p).cwiseAbs() - Vector3d::Ones()).cwiseMax(0.0).norm();
    const double gap = -row.constant * kTrust;  // and what is kept of it
    EXPECT_LE(gap, apart + 1e-9);
    const bool rests = time > 0.651 * total;
    if (rests) {
      EXPECT_EQ(row.t, 0.0);
    }
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

TEST(JointBodies, KeepsTimesWithinWhatTheFastestTakes) {
  const KnotCurve curve = Curve();
  constexpr double kSpeed = 2.0;
  const double most = kTrust / (kSpeed * curve.Duration());
  const auto rows = RowsOfTimes(curve, kSpeed, kTrust, true);
  ASSERT_EQ(rows.size(), 1u + 2u * 3u);
  EXPECT_NEAR(ValueOf(rows[0], 0, 0, -most), 0.0, 1e-12);
  EXPECT_NEAR(ValueOf(rows[1], 0, most * curve.pieces(), 0), 0.0, 1e-12);
  EXPECT_NEAR(ValueOf(rows[2], 0, -most * curve.pieces(), 0), 0.0, 1e-12);
  EXPECT_TRUE(RowsOfTimes(curve, 0.0, kTrust, true).empty());
}

}  // namespace
}  // namespace phongpd::internal
