// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>

// Exact predicates of triangles of which one is translated, in the user's own
// coordinates.  A sum like a + q is never rounded: intervals decide first,
// rationals where they cannot.  They share no code with the contact space and
// its predicates (core/bvh/exact_sign.h), because they are there to judge it.
// All points must be finite.
namespace phongpd::internal {

using Corners = std::array<Eigen::Vector3d, 3>;

// Is the area exactly zero?
bool IsDegenerate(const Corners& t);

// Does A + q meet B for some q of the segment from p to p'?  Both triangles
// closed and of non-zero area; p = p' is allowed.
//
// The sum A ⊕ [p, p'] ⊕ (−B) is convex and holds 0 iff they do.  If it does
// not, one of its facets' normals separates them: n_A, n_B or the product of
// two of the 7 edges; where the sum is flat, also n_A × edge.
bool MeetWhileMoving(const Corners& a, const Corners& b,
                     const Eigen::Vector3d& p, const Eigen::Vector3d& p2);

// The part of the motion, fractions in [0, 1], on which the two may meet, in
// floating point; 0 and 1 where it is degenerate.
std::array<double, 2> MeetingFractions(const Corners& a, const Corners& b,
                                       const Eigen::Vector3d& p,
                                       const Eigen::Vector3d& p2);

// How the ray from x = v + s·q (s = ±1) upwards along z crosses t: +1 out of
// its back, −1 into its front, 0 not at all.  x is moved by (ε, ε²) in the xy
// plane, so no crossing is on an edge; x must not lie on t.  Summed over a
// closed surface: its winding number around x.
int UpwardCrossing(const Corners& t, const Eigen::Vector3d& v,
                   const Eigen::Vector3d& q, int s);

}  // namespace phongpd::internal
