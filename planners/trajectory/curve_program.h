// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "constraints/trajectory.h"
#include "planners/trajectory/curve_cells.h"
#include "planners/trajectory/knot_curve.h"

namespace phongpd::internal {

// What the terms of the objective weigh beside the time, which is 1.
struct CurveWeights {
  double jerk = 1e-3;      // of the mean of |jerk/limit|²
  double evenness = 1e-3;  // of the mean square of ln h_{i+1} − ln h_i
  double missing = 50.0;   // of the mean missing clearance, as a share of D:
                           // CurveOptions::margin_price
};

// A knot that stays close to a point.
struct ViaKnot {
  int knot = 0;  // neither the first nor the last
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double tolerance = 0.0;  // > 0
};

struct CurveProgramOptions {
  MotionLimits limits;
  CurveWeights weights;
  double diagonal = 1.0;  // D
  double margin = 0.0;    // user's unit
  double trust = 0.0;     // τ, user's unit
  double sigma = 0.03;    // σ
  // Of each piece, in (0, 1]: how far it is trusted; empty: 1.
  std::vector<double> caution;
  // Of a curve with an end in motion: such states are kept, so that no pace
  // can make up for limits that are passed.  Then limits are less by `spare`,
  // a share, t ≥ 0 says by how much they are passed nevertheless, and has a
  // price so high that it should not be.
  bool keeps_pace = false;
  double spare = 0.0;
  std::vector<ViaKnot> via;
  // Of the jerk's term; 0: the limits, or the largest there is.
  Eigen::Vector3d jerk_scale = Eigen::Vector3d::Zero();
};

Eigen::Vector3d JerkScale(const KnotCurve& curve, const MotionLimits& limits);
// The mean of |jerk/scale|² over the time.
double MeanSquaredJerk(const KnotCurve& curve, const Eigen::Vector3d& scale);

struct CurveStep {
  // Changes of the curve, to first order; of its durations those of ln h.
  KnotCurve change;
  double predicted = 0.0;  // what the time falls by, a share
  double pace = 1.0;       // 1 + t: what limits are multiplied by
  int iterations = 0;
  int rows = 0;
};

// One round: the convex program about a curve that keeps the limits, with the
// changes Δs of its inner knots, η_i of ln h_i, a common t of the pace and the
// missing clearance m_i ≥ 0 of piece i as unknowns,
//
//   min  t + Σ (h_i/T) η_i + jerk + evenness + missing
//        + price Σ (η_i − η_{i−1})²/(σ² caution_i)
//   s.t. n·Σ w_j (B_j + ΔB_j) ≥ kept            rows of its cells
//        n·Σ w_j (B_j + ΔB_j) ≥ margin − m_i
//        |p_k + Δp_k − point| ≤ tolerance    of knots that pass a place
//        |ΔB_j|∞ ≤ τ,  |η_i| ≤ σ,  t ≥ −0.6
//        (5/h) |Δ(B + ΔB)| ≤ v(1 + t + η), and as much of the second and third
//        differences, a and j, with 2(t + η) and 3(t + η)
//
// for all Bézier points B, to first order in (Δs, η).  Beside what B neglects
// the limits are on the safe side, as e^kη is more than 1 + kη.  kept = 0.1 of
// the distance now, or as much as does not decay to rounding.  Δs = 0 is
// feasible, so any answer but an optimal one is a step too.
//
// By a primal-dual interior point method (Mehrotra's predictor and corrector)
// from within: all iterates keep all rows.  Knots know their neighbours: work
// and memory are linear in the pieces.
//
// What it neglects is of second order: a share of the step is feasible too, and
// closer to what is predicted.  States that slow down with the times about them
// (Moved, of curve_limits.h) make of it products with differences of η, which
// therefore have a price.
CurveStep SolveCurveProgram(const KnotCurve& now,
                            const std::vector<PieceCells>& cells,
                            const CurveProgramOptions& options);

// That program, to be solved with others (joint_program.h).
struct CurveProgram;
CurveProgram BuildCurveProgram(const KnotCurve& now,
                               const std::vector<PieceCells>& cells,
                               const CurveProgramOptions& options);

}  // namespace phongpd::internal
