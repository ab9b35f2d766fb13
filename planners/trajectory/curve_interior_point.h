// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planners/trajectory/block_tridiagonal.h"

namespace phongpd::internal {

// The program of one round (curve_program.h) in numbers of about 1.
//
// Unknowns of knot k, which is where piece k begins: Δp/τ, Δv·pace/5τ,
// Δa·pace²/20τ, η and m of piece k; those of the first knot's state, and all
// of the last one, are fixed.  Then t.
struct CurveProgram {
  // constant + d·Σ_j w_j ΔB_j/τ + eta·η + missing·m + t·t ≤ 0, with d a unit
  // vector along an axis, another direction, or none; or, of kNorm,
  //   |value + value_by_eta·η + Σ_j w_j ΔB_j/τ| + constant + t·t ≤ 0.
  struct Row {
    enum Kind { kAxis, kDirection, kScalar, kNorm };
    Kind kind = kScalar;
    int first = 0, last = -1;  // weights that are not 0
    int axis = 0;
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double eta = 0.0, missing = 0.0, t = 0.0, constant = 0.0;
    // The row before again with −w and −eta, of a constant of its own and
    // without m: both have the work of one.
    bool is_mirrored = false;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    Eigen::Vector3d value_by_eta = Eigen::Vector3d::Zero();
  };
  struct Piece {
    std::vector<Row> rows;
    double before = 1.0, after = 1.0;  // h over the pace of both its knots
    double share = 0.0;                // h/T
    double log_duration = 0.0;
    double missing = 0.0;                // the least m at which rows hold now
    Eigen::Matrix<double, 3, 6> by_eta;  // dB_j/dη, units of τ
    // Of each axis and point: weights of the six ΔB/τ, of η, and the value.
    std::array<Eigen::Matrix<double, 3, 8>, 3> jerk;
    double jerk_weight = 0.0;
  };
  std::vector<Piece> pieces;
  std::vector<double> pace;  // of each knot
  double evenness = 0.0;     // price of Σ (ln h_{i+1} − ln h_i)²
  double missing = 0.0;      // price of Σ m; 0: no m
  double t = 1.0;            // price of t
};

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
  static constexpr int kLocal = 21;  // ΔB, η, m, t of a piece
  using Local = Eigen::Matrix<double, kLocal, 1>;
  using LocalMatrix = Eigen::Matrix<double, kLocal, kLocal>;
  struct State {
    const CurveProgram::Row* row;
    Eigen::Vector3d direction;  // of kNorm, now
    double eta, inverse_norm;
    double slack, dual;
    double slack_step, dual_step, next_slack;
    double product;  // of the predictor's steps
  };

  void AddObjective();
  Local ToLocal(int piece, const Eigen::VectorXd& x) const;
  void AddGradient(int piece, const Local& local, Eigen::VectorXd* x) const;
  void AddMatrix(int piece, LocalMatrix* local, BlockTridiagonal* to) const;
  void Fix(BlockTridiagonal* matrix) const;
  void Fix(Eigen::VectorXd* x) const;

  static double Along(const State& state, const Local& step);
  static double Slope(const State& state, const Local& step, double* along);
  static double SlackAt(State* state, const Local& x, double* along);
  bool UpdateSlacks(const Eigen::VectorXd& x, double least_share);
  static void AddRow(const State& state, double by, double by_t,
                     LocalMatrix* matrix);
  static void AddRow(const State& state, double by, double by_t,
                     Local* gradient);
  template <typename Multiplier>
  static void AddGradients(const std::vector<State>& states,
                           const Multiplier& multiplier, Local* gradient);
  bool Begin(Eigen::VectorXd* x, int* rows);
  double AddRows(BlockTridiagonal* matrix, Eigen::VectorXd* residual) const;
  double FollowRows(const Eigen::VectorXd& step, double centre);

  const CurveProgram& program_;
  int pieces_;
  BlockTridiagonal hessian_;
  Eigen::VectorXd linear_;
  std::vector<std::vector<State>> states_;
};

}  // namespace phongpd::internal
