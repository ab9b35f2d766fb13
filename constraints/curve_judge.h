// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "constraints/free_space.h"
#include "constraints/motion_verdict.h"
#include "constraints/trajectory.h"

namespace phongpd {

using CurveVerdict = MotionVerdict;  // old name, removed in 0.3

struct CurveCheck {
  MotionVerdict verdict = MotionVerdict::kUndecided;  // also of an empty curve
  // Everything before this time is free; the duration if kFree.
  double free_until = 0.0;
  // If kCollides: when, in which piece, and where: q(time), rounded, which
  // collides exactly (in a straight piece the motion collides, near there).  If
  // kUndecided: the middle of the part that was not decided.
  double time = 0.0;
  int piece = -1;
  Eigen::Vector3d configuration = Eigen::Vector3d::Zero();
  long tests = 0;

  bool IsFree() const { return verdict == MotionVerdict::kFree; }
};

// Is the robot free for all t?  No samples are taken.  Each part of the curve
// lies in the hull H of its Bézier points.  H is free if its chord is free, by
// the exact judge, and H meets no contact triangle.  Triangles farther from the
// chord than the curve bends away from it are out of reach.  The others are
// separated from H by the plane between their closest pair of points
// (separators.h), or by the plane of a nearer triangle, if all points of H are
// above it.  A part that this does not decide is halved, and its middle point
// is tested.
//
// "Free" is a theorem about the given polynomials in the given contact spaces:
// what rounding could take from a distance, 2⁻⁴⁴ of the largest coordinate, is
// subtracted beforehand.  Straight pieces of degree 1 are judged exactly.  A
// curve that touches is not free.
//
// Undecided: a part of at most 2⁻⁴⁰ of the largest coordinate (of the curve, of
// what it moves among, and of the bounds) is neither free nor colliding; or
// `max_tests` hulls were looked at.
//
// `blur` ≥ 0 is for a curve that is known only so well: the one that is meant
// is nowhere farther than this from the one given.  Then "free" is a theorem
// about all such curves, "collides" one about the curve given, and nothing
// smaller than the blur is decided.
//
// A piece that is clear of contact takes a few microseconds.  Near contact the
// cost grows: along flat contact with the logarithm of 1/clearance, around
// corners with its square root.  Thread-safe.
CurveCheck CheckCurve(const FreeSpace& space, const Trajectory& curve,
                      long max_tests = 1'000'000, double blur = 0.0);

}  // namespace phongpd
