// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the solver of one curve, and rows counted from the knots by hand.
#include "planners/trajectory/joint_interior_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "planners/trajectory/curve_interior_point.h"
#include "planners/trajectory/curve_program.h"
#include "planners/trajectory/knot_curve.h"
#include "tests/support/curve_problems.h"

namespace phongpd::internal {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kPieces = 4;

CurveProgramOptions Options(bool by_norm) {
  CurveProgramOptions options;
  options.limits = testing::PlainLimits();
  options.limits.by_norm = by_norm;
  options.trust = 0.1;
  options.sigma = 0.1;
  return options;
}

KnotCurve Straight(const Vector3d& from, const Vector3d& to) {
  KnotCurve curve = StopAtCorners({from, to}, testing::PlainLimits(), kPieces);
  return curve;
}

JointProgram Alone(const KnotCurve& curve, bool by_norm) {
  const std::vector<PieceCells> none(kPieces);
  return {{BuildCurveProgram(curve, none, Options(by_norm))}, {false}, {}};
}

// What the time is to fall by.
double Predicted(const KnotCurve& curve, const JointProgram& program,
                 const VectorXd& x) {
  const JointUnknowns unknowns(program);
  double total = 0.0;
  for (int k = 0; k < curve.pieces(); ++k) {
    total += curve.durations[k] * std::exp(unknowns.EtaOf(k, x));
  }
  return 1.0 - total * (1.0 + x[x.size() - 1]) / curve.Duration();
}

// That of one curve has other unknowns and is as cautious as it says: without
// caution, to first order it is the same.
TEST(JointInteriorPoint, IsTheProgramOfOneCurveWhereThereIsOne) {
  const KnotCurve curve = Straight({0, 0, 0}, {3, 1, -2});
  CurveProgramOptions options = Options(false);
  options.sigma = options.trust = 1e-3;
  const std::vector<PieceCells> none(kPieces);
  CurveProgram alone = BuildCurveProgram(curve, none, options);
  for (CurveProgram::Piece& piece : alone.pieces) piece.caution = 0.0;
  const JointProgram program = {{alone}, {false}, {}};
  const auto result = JointInteriorPoint(program).Solve();
  const CurveInteriorPoint::Result truth = CurveInteriorPoint(alone).Solve();
  const double fall = -truth.x[truth.x.size() - 1];
  ASSERT_GT(fall, 1e-3);
  EXPECT_NEAR(-result.x[result.x.size() - 1], fall, 0.05 * fall);
  EXPECT_EQ(result.rows, truth.rows);
}

// Twice the same curve, without a word between them: each as alone.
TEST(JointInteriorPoint, LeavesCurvesWithoutRowsBetweenThemAlone) {
  const KnotCurve curve = Straight({0, 0, 0}, {3, 1, -2});
  for (const bool by_norm : {false, true}) {
    const JointProgram one = Alone(curve, by_norm);
    JointProgram two = one;
    two.curves.push_back(one.curves[0]);
    two.stays.push_back(false);
    const VectorXd a = JointInteriorPoint(one).Solve().x;
    const VectorXd b = JointInteriorPoint(two).Solve().x;
    EXPECT_NEAR(Predicted(curve, one, a), Predicted(curve, two, b), 2e-3);
    for (int k = 1; k < kPieces; ++k) {
      EXPECT_LT((b.segment<9>(19 * k) - b.segment<9>(19 * k + 9)).norm(), 1e-6);
    }
  }
}

// The points of a piece that x moves, and how a row stands.
double Value(const JointProgram& program, const JointProgram::Row& row,
             const VectorXd& x) {
  const int curves = static_cast<int>(program.curves.size());
  const int block = 9 * curves + 1;
  double value = row.constant;
  for (const auto& [c, sign] :
       {std::pair(row.first, 1.0), std::pair(row.second, -1.0)}) {
    const CurveProgram::Piece& of =
        program.curves[static_cast<std::size_t>(c)].pieces[row.piece];
    Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
    const auto from = x.segment<9>(block * row.piece + 9 * c);
    b.col(0) = from.head<3>();
    b.col(1) = b.col(0) + of.before * from.segment<3>(3);
    b.col(2) = b.col(0) + 2 * of.before * from.segment<3>(3) +
               of.before * of.before * from.tail<3>();
    if (row.piece + 1 < kPieces) {
      const auto to = x.segment<9>(block * (row.piece + 1) + 9 * c);
      b.col(5) = to.head<3>();
      b.col(4) = b.col(5) - of.after * to.segment<3>(3);
      b.col(3) = b.col(5) - 2 * of.after * to.segment<3>(3) +
                 of.after * of.after * to.tail<3>();
    }
    b += JointUnknowns(program).EtaOf(row.piece, x) * of.by_eta;
    value += sign * row.direction.dot(b * row.weight);
  }
  return value;
}

// Two that cross: what keeps them apart holds, binds, and costs time.
TEST(JointInteriorPoint, KeepsRowsBetweenCurves) {
  const std::vector<KnotCurve> curves = {Straight({0, 0, 0}, {4, 0, 0}),
                                         Straight({0, 0.5, 0}, {4, 0.5, 0})};
  JointProgram program = Alone(curves[0], false);
  program.curves.push_back(Alone(curves[1], false).curves[0]);
  program.stays.push_back(false);
  const VectorXd free = JointInteriorPoint(program).Solve().x;
  // The second has to move away from the first by more than it would.
  for (int j = 0; j < 6; ++j) {
    for (const int piece : {1, 2}) {
      JointProgram::Row row;
      row.piece = piece;
      row.first = 0;
      row.second = 1;
      row.from = row.to = j;
      row.weight[j] = 1.0;
      // The difference along x stays what it is to a hundredth of τ.
      row.direction = Vector3d(piece == 1 ? 1.0 : -1.0, 0.0, 0.0);
      row.constant = -0.01;
      program.rows.push_back(row);
    }
  }
  const VectorXd x = JointInteriorPoint(program).Solve().x;
  for (const JointProgram::Row& row : program.rows) {
    EXPECT_LT(Value(program, row, x), 0.0);
  }
  EXPECT_LE(Predicted(curves[0], program, x),
            Predicted(curves[0], program, free) + 1e-3);
  EXPECT_GT(Predicted(curves[0], program, x), 0.05);
  // A curve that stays does not move, and the other one still may.
  program.stays[1] = true;
  const VectorXd fixed = JointInteriorPoint(program).Solve().x;
  for (int k = 0; k < kPieces; ++k) {
    EXPECT_TRUE(fixed.segment<9>(19 * k + 9).isZero(0.0)) << k;
  }
  EXPECT_GT(fixed.segment<9>(19).norm(), 0.0);
}

// A row that does not hold to begin with: no step.
TEST(JointInteriorPoint, TakesNoStepFromOutside) {
  const KnotCurve curve = Straight({0, 0, 0}, {3, 1, -2});
  JointProgram program = Alone(curve, false);
  program.curves.push_back(program.curves[0]);
  program.stays.push_back(false);
  JointProgram::Row row;
  row.piece = 1;
  row.first = 0;
  row.second = 1;
  row.from = row.to = 2;
  row.weight[2] = 1.0;
  row.direction = Vector3d(1, 0, 0);
  row.constant = 0.5;
  program.rows.push_back(row);
  const auto result = JointInteriorPoint(program).Solve();
  EXPECT_TRUE(result.x.isZero(0.0));
  EXPECT_EQ(result.iterations, 0);
}

}  // namespace
}  // namespace phongpd::internal
