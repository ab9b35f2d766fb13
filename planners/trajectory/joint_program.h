// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/block_tridiagonal.h"
#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// The programs of several curves with knots at the same times as one: their η
// and t are common, each has unknowns of its own for its knots, and rows of two
// curves keep what they are moved along apart.
struct JointProgram {
  // constant + d·Σ_j w_j (ΔB_j of the first − ΔB_j of the second)/τ ≤ 0.
  struct PairRow {
    int piece = 0;
    int first = 0, second = 0;  // curves
    int from = 0, to = -1;      // weights that are not 0
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double constant = 0.0;
  };
  std::vector<CurveProgram> curves;  // of as many pieces; without m
  std::vector<bool> stays;           // all knots of the curve are fixed
  std::vector<PairRow> pairs;
};

// The unknowns of all curves, and as a piece sees them, u = F·x, in which rows
// and objective are written.
//
// x: of knot k, 9 of each curve, then η of piece k; t is the last.  Those of
// the first knots, and of curves that stay, are fixed.  u: of each curve
// ΔB_0 … ΔB_5 in units of τ, then η and t.
class JointUnknowns {
 public:
  explicit JointUnknowns(const JointProgram& program);

  int curves() const { return curves_; }
  int pieces() const { return pieces_; }
  int block() const { return block_; }
  int EtaAt() const { return 18 * curves_; }  // in u
  int TAt() const { return 18 * curves_ + 1; }

  // F·x, of one piece.
  Eigen::VectorXd ToLocal(int piece, const Eigen::VectorXd& x) const;
  // *x += Fᵀ·local.
  void AddGradient(int piece, const Eigen::VectorXd& local,
                   Eigen::VectorXd* x) const;
  // *to += Fᵀ·(*local)·F, of which *local does not survive.
  void AddMatrix(int piece, Eigen::MatrixXd* local, WideTridiagonal* to) const;
  // What is minimised, ½ xᵀHx + gᵀx: adds to H and g.
  void AddObjective(WideTridiagonal* hessian, Eigen::VectorXd* linear) const;
  // Leaves what is fixed where it is.
  void Fix(WideTridiagonal* matrix) const;
  void Fix(Eigen::VectorXd* x) const;

 private:
  void AddJerk(int piece, WideTridiagonal* hessian,
               Eigen::VectorXd* linear) const;
  void AddBlocks(int piece, const Eigen::MatrixXd& m,
                 WideTridiagonal* to) const;
  bool IsFixed(int knot, int curve) const {
    return knot == 0 || program_.stays[static_cast<std::size_t>(curve)];
  }

  const JointProgram& program_;
  int curves_, pieces_, block_;
};

}  // namespace phongpd::internal
