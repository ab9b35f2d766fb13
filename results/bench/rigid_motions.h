// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "constraints/rigid/rigid_judge.h"
#include "problems/scenes/rigid_scenes.h"

// Motions that judges are compared on, with a scene's robot among its
// obstacles.  Both ends are proved free; some collide on the way.
namespace phongpd::bench {

enum class RigidMotionKind {
  kRandom,   // between uniform poses
  kContact,  // between poses 1e-4 of the way before a contact, two of the
             // robot's sizes apart at most
  kGrazing,  // pairs: one that is free, and one that collides although its end
             // is elsewhere by 1e-6 of the way only
};
const char* ToString(RigidMotionKind kind);  // random, contact, grazing

struct RigidMotionEnds {
  RobotPose start, end;
};

// `count` of them (of kGrazing an even number), fewer where 10⁴ tries find no
// more.  Same seed, same motions.
std::vector<RigidMotionEnds> MakeRigidMotions(const RigidScene& scene,
                                              const RigidJudge& judge,
                                              RigidMotionKind kind, int count,
                                              unsigned seed);

// What OMPL's DiscreteMotionValidator looks at between the ends, for an
// SE3StateSpace over the scene's bounds: ⌈max(|Δq| / extent, φ / (π/2)) /
// resolution⌉ parts, φ half of the turn.
int OmplParts(const RigidScene& scene, const RigidMotionEnds& ends,
              double resolution);

}  // namespace phongpd::bench
