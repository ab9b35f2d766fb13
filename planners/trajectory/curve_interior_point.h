// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/block_tridiagonal.h"
#include "planners/trajectory/curve_row.h"
#include "planners/trajectory/interior_rows.h"
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

  // Of all rows at x, which are > 0 within them.
  void FindSlacks(const Eigen::VectorXd& x);
  // The same `alpha` of the step further on, whose slopes are known: what is
  // linear need not be looked at again.  x: there.
  void FollowSlacks(const Eigen::VectorXd& x, double alpha);
  int CountRows() const { return first_.back().bound; }
  int RowsOfPiece(int piece) const {
    return first_[piece + 1].bound - first_[piece].bound;
  }
  // act(which of rows_, which of all rows) for the norms among its rows.
  template <typename Act>
  void ForNorms(int piece, const Act& act) const;
  // Σ of weight · what t weighs.
  double SumOfT(int piece, const Eigen::ArrayXd& weights) const;
  // Products of the rows that know m, at which their duals meet its price.
  void MeetPriceOfMissing(int piece, Eigen::ArrayXd* products) const;
  bool Begin(Eigen::VectorXd* x);
  // Σ of weight · gradient of a piece's rows, of which those are the weights.
  CurveLocal SumOfRows(int piece, const double* weights) const;
  void AddRows(BlockTridiagonal* matrix, Eigen::VectorXd* residual);
  InteriorReach FollowRows(const Eigen::VectorXd& step, double centre);
  Eigen::ArrayXd BendsAlong(const Eigen::VectorXd& step) const;
  void AddCentres(double centre, Eigen::VectorXd* to);

  const CurveProgram& program_;
  int pieces_;
  BlockTridiagonal hessian_;
  Eigen::VectorXd linear_;
  // Of each piece the rows of its bounds, then its other rows.  Where its
  // first one is among all, where the first of the others is, and which that is
  // among `rows_`; and what would come next.
  struct First {
    int bound, row, other;
  };
  std::vector<First> first_;
  std::vector<CurveRowNow> rows_;
  bool has_norms_ = false;  // among `rows_`
  InteriorRows state_;
  // Of each row: slacks at a new x; slopes along a step, where there are norms.
  Eigen::ArrayXd slacks_, slopes_;
  Eigen::ArrayXd weights_;  // of the rows of one piece, or their slopes
};

}  // namespace phongpd::internal
