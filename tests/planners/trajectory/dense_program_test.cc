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

}  // namespace
}  // namespace phongpd
