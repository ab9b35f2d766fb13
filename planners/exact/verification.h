// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "constraints/trajectory.h"
#include "core/mesh/triangle_mesh.h"
#include "core/projection/penetration_metric.h"
#include "planners/world/workspace.h"

namespace phongpd {

// The result of a second judgement of a claim.
enum class Verdict {
  kConfirmed,       // holds on the original solids
  kWithinRounding,  // holds after a change by `rounding` at most, proved
  kUndecided,       // closer to contact than can be told: of curves only
  kRefuted,         // the claim is wrong, or the original solids do not show it
};
// confirmed, within_rounding, undecided, refuted
const char* ToString(Verdict verdict);

struct Verification {
  Verdict verdict = Verdict::kConfirmed;
  std::string reason;  // one sentence unless confirmed
  long tests = 0;      // of motions or points
  double seconds = 0.0;
};

// Judges paths, depths and proofs a second time: on the original solids instead
// of the contact space, and by exact predicates of its own (motion_oracle.h).
// Thread-safe.
//
// Contact spaces are rounded, to their grid and to doubles.  So a path that is
// free of the contact space may touch the original solids, or the other way
// round, but by less than
//
//     rounding = 2⁻³⁵ · r + 2⁻⁴⁸ · c,
//
// at least four steps of the grid: r is half the longest side of the bounding
// box of the larger operand (the robot, or the obstacles with the shell of the
// bounds), c the largest coordinate of all.
class Verifier {
 public:
  // Throws InputError like Workspace::Validate.
  explicit Verifier(const Workspace& workspace);
  ~Verifier();
  Verifier(Verifier&&) noexcept;
  Verifier& operator=(Verifier&&) noexcept;

  double rounding() const;

  // "The robot may follow this polyline": exact, for all points of it and
  // for the open box of the bounds.  kWithinRounding: every point of it may be
  // moved by `rounding` at most to where the robot is free, so it is nowhere
  // deeper.  Empty paths are refuted.
  Verification VerifyPath(const std::vector<Eigen::Vector3d>& path) const;

  // "The robot may follow this curve, for all t."  kConfirmed: proved, on the
  // polynomials given, with all rounding outwards; straight pieces exactly.
  // kWithinRounding as of paths.  kRefuted: at a dyadic share of a piece the
  // curve, rounded to doubles, collides, and so it does wherever it is moved to
  // by `rounding`.  kUndecided: a part no longer than 2⁻⁴⁴ of the largest
  // coordinate is none of these, or 10⁶ tests were made.  Empty trajectories
  // are refuted.
  Verification VerifyCurve(const Trajectory& curve) const;

  // "The robot collides at q, or is not strictly within the bounds": exact.
  Verification VerifyBlocked(const Eigen::Vector3d& q) const;

  // "There is no path from start to goal", by the claim that it rests on: some
  // closed part S of `contact_mesh` (of MergedObstacle) winds around one of
  // the two and not around the other, so every path crosses S, and on S the
  // robot is in contact.  Proved anew: S is closed, and the winding numbers,
  // exactly.  Sampled: at the middles of up to 500 triangles of S the
  // originals collide, `rounding` further in.  Not judged: the points of S
  // between the samples.
  Verification VerifySeparation(const TriangleMesh& contact_mesh,
                                const Eigen::Vector3d& start,
                                const Eigen::Vector3d& goal) const;

  // A depth, or a distance, of the obstacles without bounds; L is the diagonal
  // of their contact space and δ = 1e-9 L + 2 · rounding.  Inside: at q the
  // robot collides, and at q_c + s n̂ it does not, so the depth is no less
  // than it should be by more than δ.  Outside: from q to δ before q_c it is
  // free, and s behind q_c it is not.  The step s is δ, or shorter where that
  // passes through a wall or a gap, down to 2⁻⁴⁸ · c.  kWithinRounding: free,
  // or in contact, in another direction δ from q_c.  Not judged: that no way
  // out is shorter.
  Verification VerifyDepth(const Eigen::Vector3d& q,
                           const PenetrationResult& result) const;

  // "x is on the contact surface, n, of length 1, points into free space", of
  // the obstacles without bounds: at x + s n the robot is free, at x − s n it
  // is not, each for a step s as of VerifyDepth.  kWithinRounding: so in other
  // directions.
  Verification VerifySurface(const Eigen::Vector3d& x,
                             const Eigen::Vector3d& n) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phongpd
