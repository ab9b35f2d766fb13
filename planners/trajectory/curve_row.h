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

// What a row's terms weigh: those in ΔB and η, that in m and that in t.  Of two
// rows that repeat each other, what they weigh together.
struct CurveRowWeights {
  double along, missing, t;
};

// *lower += by · the square of the row's gradient, of which the terms in t
// beside others weigh by.t; and its curvature by the dual, if it is a norm.
// Below the diagonal, and on it.
void AddSquare(const CurveRowNow& now, const CurveRowWeights& by, double dual,
               CurveLocalMatrix* lower);

// *gradient += by · the row's gradient.
void AddRow(const CurveRowNow& now, const CurveRowWeights& by,
            CurveLocal* gradient);

// What rows weigh in a sum of squares of their gradients, and in one of the
// gradients.
CurveRowWeights OfSquares(CurveProgram::Row::Repeats repeats, double first,
                          double second);
CurveRowWeights OfGradients(CurveProgram::Row::Repeats repeats, double first,
                            double second);

// add(k, WEIGHTS) for the rows k from `begin` to before `end`, of weights w;
// once for two that repeat each other, of which k has all the terms.
template <CurveRowWeights (*kWeights)(CurveProgram::Row::Repeats, double,
                                      double),
          typename Add>
void ForRows(const std::vector<CurveRowNow>& rows, int begin, int end,
             const Eigen::ArrayXd& w, const Add& add) {
  using Row = CurveProgram::Row;
  for (int k = begin; k < end; ++k) {
    const Row::Repeats repeats =
        k + 1 < end ? rows[k + 1].row->repeats : Row::kNothing;
    if (repeats == Row::kNothing) {
      add(k, CurveRowWeights{w[k], w[k], w[k]});
      continue;
    }
    add(repeats == Row::kSame ? k + 1 : k, kWeights(repeats, w[k], w[k + 1]));
    ++k;
  }
}

}  // namespace phongpd::internal
