// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the projection onto a disc in closed form.
#include "planners/trajectory/dense_program.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/mesh/mesh_error.h"

namespace phongpd {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The point of the unit disc nearest to (2, 1).
struct Nearest : DenseProgram {
  explicit Nearest(double high = 1.0)
      : DenseProgram(2, VectorXd::Constant(1, -INFINITY),
                     VectorXd::Constant(1, high)) {}
  double Value(const VectorXd& x) const override {
    return (x - target).squaredNorm();
  }
  VectorXd Gradient(const VectorXd& x) const override {
    return 2.0 * (x - target);
  }
  VectorXd Rows(const VectorXd& x) const override {
    return VectorXd::Constant(is_wrong ? 2 : 1, x.squaredNorm());
  }
  MatrixXd RowGradients(const VectorXd& x) const override {
    return 2.0 * x.transpose();
  }
  void OnIterate(const VectorXd& /*x*/) override { ++iterates; }

  VectorXd target = (VectorXd(2) << 2.0, 1.0).finished();
  bool is_wrong = false;
  int iterates = 0;
};

TEST(DenseProgram, FindsTheNearestPointOfADisc) {
  Nearest program;
  const IpoptRun run =
      SolveWithIpopt(&program, VectorXd::Zero(2), DenseProgram::Settings());
  EXPECT_EQ(run.status, SolveStatus::kConverged) << run.raw_status;
  EXPECT_LT((run.x - program.target / std::sqrt(5.0)).norm(), 1e-6);
  EXPECT_GE(program.iterates, 2);
  // Without the disc in the way it is the point itself.
  Nearest wide(9.0);
  const IpoptRun free =
      SolveWithIpopt(&wide, VectorXd::Zero(2), DenseProgram::Settings());
  EXPECT_LT((free.x - wide.target).norm(), 1e-6);
}

TEST(DenseProgram, RefusesSizesAndBoundsThatDoNotFit) {
  Nearest program;
  program.is_wrong = true;
  EXPECT_THROW(
      SolveWithIpopt(&program, VectorXd::Zero(2), DenseProgram::Settings()),
      InputError);
  EXPECT_THROW(Nearest(std::nan("")), InputError);
  struct Empty : Nearest {
    Empty() : Nearest(-INFINITY) {}
  };
  EXPECT_NO_THROW(Empty());
}

// The point of [−0.8, 0.8] nearest to 2, by a row that has no value outside of
// the unit interval, and a gradient that has none beyond `end`.
struct Rooted : DenseProgram {
  explicit Rooted(double end)
      : DenseProgram(1, VectorXd::Constant(1, 0.6),
                     VectorXd::Constant(1, INFINITY)),
        end_(end) {}
  double Value(const VectorXd& x) const override {
    return (x[0] - 2.0) * (x[0] - 2.0);
  }
  VectorXd Gradient(const VectorXd& x) const override {
    return VectorXd::Constant(1, x[0] < end_ ? 2.0 * (x[0] - 2.0) : NAN);
  }
  VectorXd Rows(const VectorXd& x) const override {
    const double square = 1.0 - x[0] * x[0];
    if (square < 0.0) ++misses;
    return VectorXd::Constant(1, square < 0.0 ? NAN : std::sqrt(square));
  }
  MatrixXd RowGradients(const VectorXd& x) const override {
    return MatrixXd::Constant(1, 1, -x[0] / Rows(x)[0]);  // infinite at ±1
  }
  mutable int misses = 0;

 private:
  double end_;
};

TEST(DenseProgram, SaysThatThereIsNoValueInsteadOfNaN) {
  Rooted rooted(INFINITY);
  NonlinearProgram& program = rooted;
  double value = 0.0, slope = 0.0;
  const double inside = 0.6, edge = 1.0, outside = 1.5;
  EXPECT_TRUE(program.Constraints(&inside, &value, &slope));
  EXPECT_NEAR(value, 0.8, 1e-15);
  EXPECT_NEAR(slope, -0.75, 1e-15);
  EXPECT_TRUE(program.Constraints(&edge, &value, nullptr));
  EXPECT_FALSE(program.Constraints(&edge, &value, &slope));
  EXPECT_FALSE(program.Constraints(&outside, &value, nullptr));
  EXPECT_FALSE(program.Constraints(&outside, nullptr, &slope));
  EXPECT_EQ(value, 0.0);  // as it was left: sqrt(1 − 1)
}

TEST(DenseProgram, TurnsBackWhereThereIsNoValue) {
  Rooted program(INFINITY);
  const IpoptRun run = SolveWithIpopt(&program, VectorXd::Constant(1, -0.999),
                                      DenseProgram::Settings());
  EXPECT_EQ(run.status, SolveStatus::kConverged) << run.raw_status;
  EXPECT_NEAR(run.x[0], 0.8, 1e-6);
  EXPECT_GT(program.misses, 0);
}

TEST(DenseProgram, FailsWithNumbersWhereItStartsWithoutAGradient) {
  Rooted program(-1.0);
  const IpoptRun run =
      SolveWithIpopt(&program, VectorXd::Zero(1), DenseProgram::Settings());
  EXPECT_NE(run.status, SolveStatus::kConverged);
  for (const double x : run.x) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace phongpd
