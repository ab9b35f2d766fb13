// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "planners/trajectory/scaled_curve_program.h"

// What the interior point method asks of bounds of both sides: their rows are
// those of `at most`, point by point and axis by axis, then those of `at
// least`.
namespace phongpd::internal {

int RowsOf(const CurveProgram::Bounds& bounds);  // how many

// act(BOUNDS, which of all rows its first one is) for those of a piece, whose
// first row is `at`.
template <typename Act>
void ForBounds(const CurveProgram::Piece& piece, int at, const Act& act) {
  for (const CurveProgram::Bounds& bounds : piece.bounds) {
    act(bounds, at);
    at += RowsOf(bounds);
  }
}

// What a step of the unknowns changes each row by.
void SlopesOf(const CurveProgram::Bounds& bounds, const CurveLocal& step,
              double* slopes);

// The slack of each row at x, > 0 within.
void SlacksOf(const CurveProgram::Bounds& bounds, const CurveLocal& x,
              double* slacks);

// *lower += Σ of weight · the square of the row's gradient.  Below the
// diagonal, and on it.
void AddSquares(const CurveProgram::Bounds& bounds, const double* weights,
                CurveLocalMatrix* lower);

// *gradient += Σ of weight · the row's gradient.
void AddGradients(const CurveProgram::Bounds& bounds, const double* weights,
                  CurveLocal* gradient);

// Σ of weight · what t weighs in the row.
double TermsInT(const CurveProgram::Bounds& bounds, const double* weights);

}  // namespace phongpd::internal
