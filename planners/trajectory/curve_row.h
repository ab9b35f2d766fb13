// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// A row of the program, where the interior point method is.
struct CurveRowNow {
  const CurveProgram::Row* row;
  Eigen::Vector3d direction;  // of kNorm, now
  double eta, inverse_norm;
};

// What a step of the unknowns changes the row by, the terms in m and t
// included.  `along`: the part in ΔB and η; on entry that of the row before,
// which a row that repeats it takes over.
double Slope(const CurveRowNow& now, const CurveLocal& step, double* along);

// The slack at x, > 0 within the row; of a norm also its gradient there.
double SlackAt(CurveRowNow* now, const CurveLocal& x, double* along);

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
