// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "constraints/rigid/quaternion_motion.h"
#include "core/bvh/triangle_corners.h"

namespace phongpd::internal {

// Whether two triangles meet under a QuaternionMotion, decided exactly: in
// rational numbers, touching included, the corners and the motion as the
// doubles that they are.  Allocates; some 10 µs to milliseconds a pair.
//
// With N = |p|², M(p) the matrix of p v p̄, X_i = M r_i + N q the robot's
// corners times N, e its edges at rest and m the normal e₀ × e₁ at rest; and
// b_j, f, n the obstacle's corners, edges and normal, these are cubic in t:
//
//   corner i and the obstacle's plane   n · (X_i − N b_j)
//   corner j and the robot's plane      m · (Mᵀ (b_j − q) − N r_i)
//   two edges                           f · M (r × e) + M e · (f × (q − b))
//   corner i over the obstacle's edge   (n × f) · (X_i − N b_j)
//   corner j over the robot's edge      (m × e) · (Mᵀ (b_j − q) − N r_i)
//
// The signs of all 33 of them say whether the triangles meet.  So the least
// time of contact is the start of the part, or a root of one that is not 0 for
// all t, of the first 15 unless one of the first 6 is 0 for all t.  Roots are
// isolated by Sturm's sequence, and the other signs there found by halving, or
// by a common root.
class ExactPairJudge {
 public:
  explicit ExactPairJudge(const QuaternionMotion& motion);
  ~ExactPairJudge();

  // Do they share a point at some time in [from, to]?  *time is one of them, to
  // 2⁻⁵⁰ or so of the part.  Triangles of no area are not decided: false, and
  // *is_decided is.
  bool Meet(const TriangleCorners& robot, const TriangleCorners& obstacle,
            double from, double to, double* time, bool* is_decided) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace phongpd::internal
