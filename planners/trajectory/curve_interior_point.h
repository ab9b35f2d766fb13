// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/block_tridiagonal.h"
#include "planners/trajectory/curve_row.h"
#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// Minimises a scaled program by a primal-dual interior point method with
// Mehrotra's predictor and corrector; its matrices are block tridiagonal with a
// border.
class CurveInteriorPoint {
 public:
  explicit CurveInteriorPoint(const CurveProgram& program);

  struct Result {
    Eigen::VectorXd x;
    int iterations = 0;
    int rows = 0;
  };
  // Always within all rows, whenever it ends.
  Result Solve();

 private:
  static constexpr int kBlock = BlockTridiagonal::kSize;

  void Fix(BlockTridiagonal* matrix) const;
  void Fix(Eigen::VectorXd* x) const;

  bool UpdateSlacks(const Eigen::VectorXd& x, double least_share);
  bool Begin(Eigen::VectorXd* x, int* rows);
  double AddRows(BlockTridiagonal* matrix, Eigen::VectorXd* residual) const;
  double FollowRows(const Eigen::VectorXd& step, double centre);

  const CurveProgram& program_;
  int pieces_;
  BlockTridiagonal hessian_;
  Eigen::VectorXd linear_;
  std::vector<std::vector<CurveRowState>> states_;
};

}  // namespace phongpd::internal
