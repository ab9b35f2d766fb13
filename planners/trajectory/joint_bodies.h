// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "constraints/moving_judge.h"
#include "planners/trajectory/curve_cells.h"
#include "planners/trajectory/joint_program.h"
#include "planners/trajectory/knot_curve.h"

// What moves by itself, in the program of several curves.
namespace phongpd::internal {

// The largest speed of all their motions, an upper bound; 0: none moves.
double LargestSpeed(const std::vector<MovingBody>& bodies);

// Rows that keep a curve, the `index`-th of the program, off a body that moves
// on its own clock, which begins when the curve does.  For each piece, parted
// where the body's pieces end: half-spaces of the judge's proof for the points
// of the curve less those of the body's motion in the same time, of degree 5
// (a body of a higher degree is followed as well as that can; the judge has the
// last word), as they change with the curve's points and, to first order, with
// the times at which it comes there; of these, t counts only if `follows_t`.
//
// `trust`: what points are moved by at most, and what the body moves by at most
// in what times change by.  `margin`: the distance wished for; rows keep what
// there is of it (JointRowConstant).
std::vector<JointProgram::Row> RowsAgainst(const MovingBody& body,
                                           const KnotCurve& curve, int index,
                                           double trust, double margin,
                                           bool follows_t);

// Rows by which times change by no more than the fastest body takes for
// `trust`.
std::vector<JointProgram::Row> RowsOfTimes(const KnotCurve& curve, double speed,
                                           double trust, bool follows_t);

// What a row keeps of a clearance, but for what is above the margin, less the
// gap there is: its constant, times τ.
double JointRowConstant(const ClearanceRow& row, double margin);

}  // namespace phongpd::internal
