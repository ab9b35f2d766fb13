// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "constraints/motion_verdict.h"
#include "constraints/rigid/quaternion_motion.h"
#include "constraints/rigid/rigid_clearance.h"
#include "constraints/rigid/rigid_motion.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

using RigidOutcome = MotionVerdict;  // what it was called, until 0.3

struct RigidCheck {
  MotionVerdict outcome = MotionVerdict::kUndecided;
  // Of kCollides: a time at which it does, not the first.  Of kUndecided: the
  // middle of the part of the way that is not decided.
  double time = 0.0;
  double from = 0.0, to = 1.0;  // of kUndecided: that part
  // Which triangles meet, or are not told apart: numbers in the meshes, and the
  // meshes in the lists given.  −1: one solid holds a part of the other
  // (kCollides), or nothing was looked at (kUndecided).
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  long tests = 0;  // pairs of boxes and triangles looked at

  bool IsFree() const { return outcome == MotionVerdict::kFree; }
};

// When does it collide first?
struct RigidFirstHit {
  MotionVerdict outcome = MotionVerdict::kUndecided;
  // kCollides: free on [0, from), proved, and colliding at `to`, proved; the
  // first contact lies between.  kUndecided: free before `from` and after `to`,
  // proved.  kFree: 0 and 1.
  double from = 0.0, to = 1.0;
  // Which triangles meet at `to`, or are the first found that are not told
  // apart; −1 as of RigidCheck.
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  long tests = 0;
};

// Does a robot that moves and turns (rigid_motion.h) meet fixed obstacles?  No
// samples: pairs of boxes, then of triangles, are parted by a direction for a
// part of the way; each pair halves its own part until that holds
// (rigid_pair.h), or a triangle is seen to run through another.
//
// "Free" and "collides" are theorems about the meshes and the motion given:
// rounding is taken off every gap beforehand, and added to what a meeting must
// stand.  With S the sum of the robot's reach from its origin, of that origin's
// from the middle of the obstacles and of their own, and θ the turn, that is
// 2⁻⁴⁴ S (1 + θ)².  What touches is not free.
//
// Surfaces: triangles, closed or not, of any quality.  A mesh that is closed,
// consistently oriented and edge-manifold bounds a solid, { p : w(p) > 0 } as
// in solid.h: a part of the other side that is wholly inside of it collides
// with it, too.  One turned inside out is a room, and bounds none.  Vertices
// that a file repeats are not joined: MakeSolid does that.
//
// Undecided: two triangles come closer than about 1e-7 of half the robot's
// diagonal (or than 4 times the rounding), or meet by no more; they touch along
// edges or in one plane; or `max_tests` pairs were looked at.
//
// An immutable handle, cheap to copy.  Queries are thread-safe and do not
// allocate.  From 10 µs to some milliseconds a motion.
class RigidJudge {
 public:
  // Throws InputError for meshes without triangles, with invalid indices or
  // coordinates that are not finite or out of range (mesh_range.h).
  RigidJudge(const TriangleMesh& robot, const TriangleMesh& obstacle);
  // The robot is all of `robot` at once, so are the obstacles.
  RigidJudge(const std::vector<TriangleMesh>& robot,
             const std::vector<TriangleMesh>& obstacles);

  static constexpr long kMaxTests = 10'000'000;

  // Throws InputError where the way is more than 1e100 times as far from the
  // obstacles as the meshes are large, which no rounding stands.
  RigidCheck Check(const RigidMotion& motion, long max_tests = kMaxTests) const;
  // By the same proofs, of a motion whose turn is not at a constant rate.
  RigidCheck Check(const QuaternionMotion& motion,
                   long max_tests = kMaxTests) const;

  // Exact: pairs of triangles that come within about 1e-4 of half the robot's
  // diagonal are decided in rational numbers, where Check does not tell them
  // apart.  What touches, if only in a point at a moment, collides, at `time`
  // to rounding.  Undecided: triangles without area, named, that come as close;
  // or max_tests.  Who is inside of whom without touching is told by corners as
  // rounded.  Allocates; as fast as Check where nothing comes close, else about
  // 1 ms more for each such pair and part.
  RigidCheck CheckExactly(const QuaternionMotion& motion,
                          long max_tests = kMaxTests) const;

  // The first contact, to − from ≤ resolution, a share of the way in (0, 1],
  // where rounding and what lies before it allow: a part before the hit that is
  // not decided begins at `from`, however far the hit is.  2 to 5 times as
  // long as Check, tenfold for a dozen triangles.  Throws InputError as Check,
  // and for another resolution.
  RigidFirstHit FirstHit(const RigidMotion& motion, double resolution = 1e-9,
                         long max_tests = kMaxTests) const;

  // How close it comes (rigid_clearance.h), 0 where it collides.  Some
  // milliseconds to the default tolerance: 6 to 30 times as long as Check near
  // contact, 30 to 140 times far away, where Check has little to do.  Throws
  // InputError as Check, and for a tolerance out of range.
  RigidClearance Clearance(const RigidMotion& motion,
                           const ClearanceTolerance& tolerance = {},
                           long max_tests = kMaxTests) const;
  RigidClearance Clearance(const QuaternionMotion& motion,
                           const ClearanceTolerance& tolerance = {},
                           long max_tests = kMaxTests) const;
  // Of all the motions from pose to pose of a path, at least one pose, with
  // max_tests for each: the closest of them is named, and measured.
  RigidClearance PathClearance(const std::vector<RobotPose>& path,
                               const ClearanceTolerance& tolerance = {},
                               long max_tests = kMaxTests) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace phongpd
