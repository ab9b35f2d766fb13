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
  // |value_j + scale·(Δᵏ(ΔB/τ))_j| + t·(t + η) ≤ most, axis by axis, for j
  // from first to last: of the points of a derivative of order k, with Δᵏ the
  // differences of order k; or, k = 0, of the points.  An axis that is not
  // bounded has scale, value and t 0.
  struct Bounds {
    int order = 0;  // k
    int first = 0, last = -1;
    Eigen::Array3d scale = Eigen::Array3d::Zero();
    Eigen::Array<double, 3, 6> value = Eigen::Array<double, 3, 6>::Zero();
    Eigen::Array3d t = Eigen::Array3d::Zero();
    double most = 1.0;
  };
  // constant + d·Σ_j w_j ΔB_j/τ + eta·η + missing·m + t·t ≤ 0, with a unit
  // vector d, or none; or, of kNorm,
  //   |value + Σ_j w_j ΔB_j/τ| + constant + eta·η + t·t ≤ 0.
  struct Row {
    enum Kind { kDirection, kScalar, kNorm };
    Kind kind = kScalar;
    int first = 0, last = -1;  // weights that are not 0
    Eigen::Matrix<double, 6, 1> weight = Eigen::Matrix<double, 6, 1>::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double eta = 0.0, missing = 0.0, t = 0.0, constant = 0.0;
    // But for its constant and m the row before, which is without m, so that
    // both have the work of one.
    bool repeats = false;
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
  };
  struct Piece {
    std::vector<Bounds> bounds;
    std::vector<Row> rows;
    double before = 1.0, after = 1.0;  // h over the pace of both its knots
    double share = 0.0;                // h/T
    double log_duration = 0.0;
    // Price of (η_i − η_{i−1})²; of two pieces the higher one.
    double caution = 0.0;
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

  int size() const { return static_cast<int>(pieces.size()); }
};

// What differences of order k are of the k + 1 points from theirs on.
inline constexpr std::array<std::array<double, 4>, 4> kDifferences = {
    {{1, 0, 0, 0}, {-1, 1, 0, 0}, {1, -2, 1, 0}, {-1, 3, -3, 1}}};

// The unknowns as a piece sees them, u = F·x: ΔB_0 … ΔB_5 in units of τ, axis
// by axis, then η, m and t.  Rows and objective are written in these.
inline constexpr int kCurveEta = 18, kCurveMissing = 19, kCurveT = 20;
using CurveLocal = Eigen::Matrix<double, 21, 1>;
using CurveLocalMatrix = Eigen::Matrix<double, 21, 21>;

// F·x, of one piece.
CurveLocal ToLocal(const CurveProgram& program, int piece,
                   const Eigen::VectorXd& x);

// *x += Fᵀ·local.
void AddGradient(const CurveProgram& program, int piece,
                 const CurveLocal& local, Eigen::VectorXd* x);

// *to += Fᵀ·(*local)·F, of which *local does not survive.
void AddMatrix(const CurveProgram& program, int piece, CurveLocalMatrix* local,
               BlockTridiagonal* to);

// What is minimised, ½ xᵀHx + gᵀx: adds to H and g.
void AddObjective(const CurveProgram& program, BlockTridiagonal* hessian,
                  Eigen::VectorXd* linear);

}  // namespace phongpd::internal
