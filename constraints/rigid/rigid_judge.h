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

using RigidOutcome = MotionVerdict;  // old name, removed in 0.3

// Is a motion free?  Times are shares of the motion, t in [0, 1].
struct RigidCheck {
  MotionVerdict outcome = MotionVerdict::kUndecided;
  // kCollides: a time of a collision, not always the first one.  kUndecided:
  // the middle of an interval [from, to] that could not be decided.
  double time = 0.0;
  double from = 0.0, to = 1.0;  // kUndecided: that interval
  // The triangles that intersect, or could not be separated: the index of the
  // mesh in its list, and of the triangle in the mesh.  −1: a part of one solid
  // lies inside the other (kCollides), or nothing was tested (kUndecided).
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  long tests = 0;  // pairs of boxes and of triangles tested

  bool IsFree() const { return outcome == MotionVerdict::kFree; }
};

// When does a motion collide first?  Times are shares of it, in [0, 1].
struct RigidFirstHit {
  MotionVerdict outcome = MotionVerdict::kUndecided;
  // kCollides: proved free on [0, from) and proved colliding at `to`; the first
  // contact lies between.  kUndecided: proved free before `from` and after
  // `to`.  kFree: 0 and 1.
  double from = 0.0, to = 1.0;
  // The triangles that intersect at `to`, or the first pair found that could
  // not be separated; −1 means what it means in RigidCheck.
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  long tests = 0;
};

// Is a motion of a robot that translates and turns (rigid_motion.h) free of
// fixed obstacles?  Continuous collision detection without samples: a pair of
// boxes, then of triangles, is separated by a plane for an interval of time.
// Where no plane does it, that pair alone halves its interval (rigid_pair.h),
// until a plane is found or a triangle is proved to run through the other.
//
// kFree and kCollides are proofs about the given meshes and motion, rounding
// included: a gap counts only beyond the rounding, and an intersection only if
// it is deeper.  The bound on rounding is 2⁻⁴⁴ S (1 + θ)².  θ is the angle of
// the turn; S is the sum of the robot's reach from its origin, the farthest
// that this origin gets from the middle of the obstacles, and their reach from
// there.  Touching is not free.
//
// The meshes need not be closed, and may have triangles of any shape.  A mesh
// that is closed, consistently oriented and edge-manifold bounds the solid
// { p : w(p) > 0 } of solid.h.  Then a mesh that lies wholly inside that solid
// collides, too.  A mesh that is inside out is a room: its inside is free.
// Vertices that a file repeats are not joined; MakeSolid joins them.  Of
// triangles with the same corners only the first is looked at, and named.
//
// kUndecided: two triangles come closer than about 1e-7 of half the robot's
// diagonal (or 4 times the rounding), or intersect by no more than that; they
// touch along edges or in one plane; or `max_tests` pairs were tested.
//
// For robots that only translate, MotionOracle and FreeSpace are exact.  An
// immutable handle, cheap to copy.  Queries are thread-safe and do not
// allocate.  A motion takes from 10 µs to some milliseconds.
class RigidJudge {
 public:
  // Throws InputError for a mesh without triangles, with invalid indices, or
  // with coordinates that are not finite or out of range (mesh_range.h).
  RigidJudge(const TriangleMesh& robot, const TriangleMesh& obstacle);
  // All meshes of `robot` move together as one body.
  RigidJudge(const std::vector<TriangleMesh>& robot,
             const std::vector<TriangleMesh>& obstacles);

  static constexpr long kMaxTests = 10'000'000;

  // Throws InputError if the motion is more than 1e100 times as far from the
  // obstacles as the meshes are large: rounding would be larger than they are.
  RigidCheck Check(const RigidMotion& motion, long max_tests = kMaxTests) const;
  // The same for a motion that does not turn at a constant rate.
  RigidCheck Check(const QuaternionMotion& motion,
                   long max_tests = kMaxTests) const;

  // Exact: where Check's planes do not separate two triangles that come within
  // about 1e-4 of half the robot's diagonal, rational arithmetic decides.
  // Touching collides, even in one point at one moment; `time` is that moment
  // to rounding.  Only two things are undecided: such a pair with a triangle
  // without area, and max_tests.  Whether one solid lies inside the other
  // without touching it is decided by rounded corners.  Allocates.  As fast as
  // Check if nothing comes close; otherwise each such pair and interval takes
  // about 1 ms more.
  RigidCheck CheckExactly(const QuaternionMotion& motion,
                          long max_tests = kMaxTests) const;

  // The first contact: to − from ≤ resolution, a share of the motion in (0, 1].
  // The interval is longer where rounding does not allow this, and where an
  // undecided interval lies before the hit: then `from` is where that begins.
  // Takes 2 to 5 times as long as Check; 10 times for a dozen triangles.
  // Throws InputError like Check, and for a resolution out of range.
  RigidFirstHit FirstHit(const RigidMotion& motion, double resolution = 1e-9,
                         long max_tests = kMaxTests) const;

  // The smallest distance during the motion, user's unit, 0 if it collides
  // (rigid_clearance.h).  Takes some milliseconds with the default tolerance: 6
  // to 30 times as long as Check near contact, and 30 to 140 times far away,
  // where Check has little to do.  Throws InputError like Check, and for a
  // tolerance out of range.
  RigidClearance Clearance(const RigidMotion& motion,
                           const ClearanceTolerance& tolerance = {},
                           long max_tests = kMaxTests) const;
  RigidClearance Clearance(const QuaternionMotion& motion,
                           const ClearanceTolerance& tolerance = {},
                           long max_tests = kMaxTests) const;
  // The smallest clearance of all motions from pose to pose of a path of one
  // pose or more; `motion` tells which one has it.  max_tests for each motion.
  RigidClearance PathClearance(const std::vector<RobotPose>& path,
                               const ClearanceTolerance& tolerance = {},
                               long max_tests = kMaxTests) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace phongpd
