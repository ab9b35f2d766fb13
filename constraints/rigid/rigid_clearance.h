// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/rigid/rigid_motion.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// The smallest distance c of robot and obstacles during a motion, user's unit:
//
//   c = min over t ∈ [0, 1] of their distance at t,   lower ≤ c ≤ upper
//
// Both bounds are proved, rounding included.  Solids are filled: the distance
// is 0 if they touch, or if one lies inside the other.
struct RigidClearance {
  // At no time are they nearer.  If > 0, the motion is free.
  double lower = 0.0;
  // At `time` they are at most so far apart.
  double upper = 0.0;
  double time = 0.0;  // in [0, 1]
  int motion = 0;     // of a path: the motion from pose `motion` to the next
  // The nearest triangles at that time: the index of the mesh in its list, and
  // of the triangle in the mesh.  −1: a part of one side lies inside the other.
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  // Is upper − lower at most the tolerance asked for?  (Or as small as can be
  // resolved: 1e-9 of half the robot's diagonal, or 4 times the rounding, see
  // rigid_judge.h.)  False: `max_tests` pairs were tested, or triangles are so
  // thin that rounding hides their distance.
  bool is_resolved = false;
  long tests = 0;  // pairs of boxes and of triangles tested
};

// The accuracy asked for: upper − lower ≤ max(relative · upper, absolute).
struct ClearanceTolerance {
  double relative = 1e-3;  // in [0, 1)
  double absolute = 0.0;   // user's unit, ≥ 0
};

// The clearance of one motion of one mesh among another.  For several motions
// make a RigidJudge, and keep it.  Throws InputError like RigidJudge and its
// Clearance.
RigidClearance MotionClearance(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const RigidMotion& motion,
                               const ClearanceTolerance& tolerance = {});

}  // namespace phongpd
