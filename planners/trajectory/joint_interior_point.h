// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
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

// By Mehrotra's predictor and corrector from within, as CurveInteriorPoint; a
// knot's block has the unknowns of all curves.  Limits by norm are rows that
// touch the ball where the curve is now: what that neglects is of second order,
// as the rest.
class JointInteriorPoint {
 public:
  explicit JointInteriorPoint(const JointProgram& program);

  struct Result {
    // Of knot k: 9 of each curve, then η of piece k; t is the last.
    Eigen::VectorXd x;
    int iterations = 0;
    int rows = 0;
  };
  Result Solve();

 private:
  // sign · (along) + t · (its unknown) + constant ≤ 0, of both signs where
  // there are two sides.
  struct Side {
    double constant = 0.0, slack = 0.0, dual = 0.0;
    double slack_step = 0.0, dual_step = 0.0, product = 0.0;
  };
  struct Line {
    int first = -1, second = -1;  // curves; −1: none
    int from = 0, to = -1;
    int axis = -1;  // of the direction, or −1
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double eta = 0.0, t = 0.0;
    int sides = 1;
    std::array<Side, 2> side;
  };

  int EtaAt() const { return 18 * curves_; }
  int TAt() const { return 18 * curves_ + 1; }
  void AddLines(int curve, int piece);
  void AddNormLines(int curve, const CurveProgram::Row& row,
                    std::vector<Line>* lines) const;
  void AddPairs();
  void AddObjective();
  void AddJerk(int piece);
  Eigen::VectorXd ToLocal(int piece, const Eigen::VectorXd& x) const;
  void AddGradient(int piece, const Eigen::VectorXd& local,
                   Eigen::VectorXd* x) const;
  void AddMatrix(int piece, Eigen::MatrixXd* local, WideTridiagonal* to) const;
  void Fix(WideTridiagonal* matrix) const;
  void Fix(Eigen::VectorXd* x) const;
  bool IsFixed(int knot, int curve) const {
    return knot == 0 || program_.stays[static_cast<std::size_t>(curve)];
  }

  double Along(const Line& line, const Eigen::VectorXd& local) const;
  void AddSquare(const Line& line, double by, Eigen::MatrixXd* m) const;
  void AddLine(const Line& line, double by, Eigen::VectorXd* local) const;
  bool Begin(Eigen::VectorXd* x, int* rows);
  double AddRows(WideTridiagonal* matrix, Eigen::VectorXd* residual) const;
  double FollowRows(const Eigen::VectorXd& step, double centre);
  void AddCentres(double centre, Eigen::VectorXd* to) const;

  const JointProgram& program_;
  int curves_, pieces_, block_;
  WideTridiagonal hessian_;
  Eigen::VectorXd linear_;
  std::vector<std::vector<Line>> lines_;  // by piece
};

}  // namespace phongpd::internal
