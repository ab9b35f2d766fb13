// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// A row of the program, where the interior point method is: its gradient.
//
// |y| ≤ u, of kNorm, is y²/u − u ≤ 0 here: convex, smooth at y = 0, and within
// it −ln(u − y²/u) is all but the barrier of the cone, so that steps go far.
// Its curvature is (2/u) (Δy − (y/u) Δu)².
struct CurveRowNow {
  explicit CurveRowNow(const CurveProgram::Row& of)
      : row(&of), direction(of.direction), eta(of.eta), t(of.t) {}

  const CurveProgram::Row* row;
  Eigen::Vector3d direction;
  double eta, t;
  double bend = 0.0;  // of kNorm: 2/u
};

// What a step of the unknowns changes the row by, the terms in m and t
// included.  `along`: the part in ΔB and η; on entry that of the row before,
// which a row that repeats it takes over.
double Slope(const CurveRowNow& now, const CurveLocal& step, double* along);

// The slack at x, > 0 within the row; of a norm also its gradient there.
double SlackAt(CurveRowNow* now, const CurveLocal& x, double* along);

// By how much more a step changes a row of kNorm, to second order.
double BendOf(const CurveRowNow& now, const CurveLocal& step);

// What a row's terms weigh: those in ΔB, η and t, and those in m.  Of two rows
// of which one repeats the other, what they weigh together.
struct CurveRowWeights {
  double along, missing;
};

// *lower += by · the square of the row's gradient; and its curvature by the
// dual, if it is a norm.  Below the diagonal, and on it.
void AddSquare(const CurveRowNow& now, const CurveRowWeights& by, double dual,
               CurveLocalMatrix* lower);

// *gradient += by · the row's gradient.
void AddRow(const CurveRowNow& now, const CurveRowWeights& by,
            CurveLocal* gradient);

// add(ROW, WEIGHTS) for the rows from `begin` to before `end`, of weights w
// from its entry `at` on; once for two of which one repeats the other.
template <typename Add>
void ForRows(const std::vector<CurveRowNow>& rows, int begin, int end,
             const Eigen::ArrayXd& w, int at, const Add& add) {
  for (int k = begin; k < end; ++k, ++at) {
    const bool is_pair = k + 1 < end && rows[k + 1].row->repeats;
    if (!is_pair) {
      add(k, CurveRowWeights{w[at], w[at]});
      continue;
    }
    add(k + 1, CurveRowWeights{w[at] + w[at + 1], w[at + 1]});
    ++k;
    ++at;
  }
}

}  // namespace phongpd::internal
