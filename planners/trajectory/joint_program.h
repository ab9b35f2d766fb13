// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/block_tridiagonal.h"
#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// The programs of several curves with knots at the same times as one: the times
// and t are common, each curve has unknowns of its own for its knots, and rows
// of two curves keep what they are moved along apart.
//
// When knot k comes changes by T (θ_k/M + t·T_k/T), M pieces in the time T, so
// that η_k = (θ_{k+1} − θ_k)/(M h_k/T).  The first knot comes at 0, and θ of
// the end is 0: what the whole time changes by is t.
struct JointProgram {
  // constant + d·Σ_j w_j (ΔB_j of the first − ΔB_j of the second)/τ
  //   + eta·η + theta·θ + t·t ≤ 0.
  struct Row {
    int piece = 0;
    int first = -1, second = -1;  // curves; −1: none
    int from = 0, to = -1;        // weights that are not 0
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double constant = 0.0;
    double eta = 0.0, theta = 0.0, t = 0.0;  // θ of the piece's first knot
  };
  std::vector<CurveProgram> curves;  // of as many pieces; without m
  std::vector<bool> stays;           // all knots of the curve are fixed
  std::vector<Row> rows;
  // Other knots that are fixed, of each curve; may be empty.
  std::vector<std::vector<int>> rests{};
};

// The unknowns of all curves, and as a piece sees them, u = F·x, in which rows
// and objective are written.
//
// x: of knot k, 9 of each curve, then θ_k; t is the last.  Those of the first
// knots, of curves that stay and of those that rest are fixed.  u: of each
// curve ΔB_0 … ΔB_5 in units of τ, then η, θ of the piece's first knot, and t.
class JointUnknowns {
 public:
  explicit JointUnknowns(const JointProgram& program);

  int curves() const { return curves_; }
  int pieces() const { return pieces_; }
  int block() const { return block_; }
  int EtaAt() const { return 18 * curves_; }  // in u
  int ThetaAt() const { return 18 * curves_ + 1; }
  int TAt() const { return 18 * curves_ + 2; }

  // η of a piece.
  double EtaOf(int piece, const Eigen::VectorXd& x) const;
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
  void AddPiece(int piece, WideTridiagonal* hessian,
                Eigen::VectorXd* linear) const;
  void AddBlocks(int piece, const Eigen::MatrixXd& m,
                 WideTridiagonal* to) const;
  bool IsFixed(int knot, int curve) const {
    return is_fixed_[static_cast<std::size_t>(curve * pieces_ + knot)];
  }
  // M h/T.
  double Share(int piece) const {
    return pieces_ * program_.curves[0].pieces[piece].share;
  }

  const JointProgram& program_;
  int curves_, pieces_, block_;
  std::vector<bool> is_fixed_;  // curve by curve
};

}  // namespace phongpd::internal
