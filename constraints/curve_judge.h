// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/free_space.h"
#include "constraints/motion_verdict.h"
#include "constraints/trajectory.h"

namespace phongpd {

using CurveVerdict = MotionVerdict;  // what it was called, until 0.3

struct CurveCheck {
  MotionVerdict verdict = MotionVerdict::kUndecided;  // also of an empty curve
  // Everything before is free; the duration for kFree.
  double free_until = 0.0;
  // Of kCollides: when, in which piece, and where, q(time) rounded, which
  // collides exactly (of a straight piece the motion does, at about there).  Of
  // kUndecided: in the middle of what is not.
  double time = 0.0;
  int piece = -1;
  Eigen::Vector3d configuration = Eigen::Vector3d::Zero();
  long tests = 0;

  bool IsFree() const { return verdict == MotionVerdict::kFree; }
};

// Is the robot free for all t?  No samples: each part of the curve is in the
// hull H of its Bézier points, and that is free if its chord is, by the exact
// judge, and H meets no contact triangle.  Triangles farther from the chord
// than the curve bends away from it are not in reach; the others are told
// apart by the plane of the pair closest to each other (separators.h), if all
// points of H are above it, or by that of a nearer one.  A part that this does
// not decide is halved, and its middle is asked for.
//
// "Free" is a theorem about the polynomials given, in the contact spaces given:
// what rounding could take from a distance, 2⁻⁴⁴ of the largest coordinate, is
// taken off beforehand.  Straight pieces of degree 1 are judged exactly.
// A curve that touches is not free.
//
// Undecided: a part no longer than 2⁻⁴⁰ of the largest coordinate (of the
// curve, of what it moves among, and of the bounds) is neither free nor
// colliding, or `max_tests` hulls were looked at.
//
// `blur` ≥ 0: the curve meant is that close to the one given, in distance; then
// "free" is a theorem about all such curves, "collides" about the one given,
// and nothing smaller than the blur is decided.
//
// Costs a few microseconds a piece that is clear of contact, and grows with
// the logarithm of the curve's clearance along flat contact, with the square
// root of its inverse around corners.  Thread-safe.
CurveCheck CheckCurve(const FreeSpace& space, const Trajectory& curve,
                      long max_tests = 1'000'000, double blur = 0.0);

}  // namespace phongpd
