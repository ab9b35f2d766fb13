// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "planners/trajectory/scaled_curve_program.h"

namespace phongpd::internal {

// A row of the program, where the interior point method is: its gradient.
//
// |y| ≤ u, of kNorm, is y²/u − u ≤ 0 here: convex, smooth at y = 0, and within
// it −ln(u − y²/u) is all but the barrier of the cone, so that steps go far.
// Its curvature is (2/u) (Δy − (y/u) Δu)².
//
// All that iterations read of many rows again and again is here, close
// together: programs of long curves do not fit into the caches.
struct CurveRowNow {
  explicit CurveRowNow(const CurveProgram::Row& of);

  const CurveProgram::Row* row;
  Eigen::Vector3d direction;
  double eta, t, missing;
  double bend = 0.0;  // of kNorm: 2/u
  Eigen::Matrix<double, 6, 1> weight;
  std::int8_t kind, first, last;
  // Two rows: this one without its m, and then the one that repeats it, which
  // is the next one of the program, with m.
  bool is_pair = false;
};

// Those of some rows of a program, which must outlive them.
void AppendRows(const std::vector<CurveProgram::Row>& rows,
                std::vector<CurveRowNow>* to);

// What a step of the unknowns changes the row by, or both rows; returns where
// the next one's comes.
double* WriteSlopes(const CurveRowNow& now, const CurveLocal& step, double* to);

// The slack at x, > 0 within the row, or of both rows; of a norm also its
// gradient there.  Returns where the next one's comes.
double* WriteSlacks(CurveRowNow* now, const CurveLocal& x, double* to);

// By how much more a step changes a row of kNorm, to second order.
double BendOf(const CurveRowNow& now, const CurveLocal& step);

// What a row's terms weigh: those in ΔB, η and t, and those in m.  Of a pair,
// what they weigh together.
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

// add(ROW, WEIGHTS, where its weight is) for the rows from `begin` to before
// `end`, of weights from `w` on.
template <typename Add>
void ForRows(const std::vector<CurveRowNow>& rows, int begin, int end,
             const double* w, const Add& add) {
  for (int at = 0; begin < end; ++begin) {
    if (rows[begin].is_pair) {
      add(rows[begin], CurveRowWeights{w[at] + w[at + 1], w[at + 1]}, at);
      at += 2;
    } else {
      add(rows[begin], CurveRowWeights{w[at], w[at]}, at);
      ++at;
    }
  }
}

}  // namespace phongpd::internal
