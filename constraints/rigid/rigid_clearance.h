// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "constraints/rigid/rigid_motion.h"
#include "core/mesh/triangle_mesh.h"

namespace phongpd {

// How close the robot comes to the obstacles on its way,
//
//   c = min over t ∈ [0, 1] of the distance of the two,  lower ≤ c ≤ upper,
//
// both proved, rounding included; user's unit.  A solid is filled: who is
// inside of one is at distance 0, as is who touches.
struct RigidClearance {
  // No nearer for any t.  Above 0 the motion is free; 0 says nothing.
  double lower = 0.0;
  // So near, or nearer, at `time`.
  double upper = 0.0;
  double time = 0.0;  // in [0, 1]
  int motion = 0;     // of a path: from pose `motion` to the next one
  // Which triangles are so near then; −1: one side holds a part of the other.
  int robot_mesh = -1, robot_triangle = -1;
  int obstacle_mesh = -1, obstacle_triangle = -1;
  // upper − lower is at most the tolerance that was asked for, or what can be
  // told at all: 1e-9 of half the robot's diagonal, or 4 times the rounding
  // (rigid_judge.h).  False: `max_tests` pairs were looked at, or triangles are
  // so thin that rounding hides how far apart they are.
  bool is_resolved = false;
  long tests = 0;  // pairs of boxes and triangles looked at
};

// How well it is wanted: upper − lower ≤ max(relative · upper, absolute).
struct ClearanceTolerance {
  double relative = 1e-3;  // in [0, 1)
  double absolute = 0.0;   // user's unit, ≥ 0
};

// For one motion of two meshes; who asks again keeps a RigidJudge.  Throws
// InputError as RigidJudge and its Clearance.
RigidClearance MotionClearance(const TriangleMesh& robot,
                               const TriangleMesh& obstacle,
                               const RigidMotion& motion,
                               const ClearanceTolerance& tolerance = {});

}  // namespace phongpd
