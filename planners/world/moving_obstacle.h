// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "constraints/moving_judge.h"
#include "constraints/trajectory.h"
#include "core/solid/solid.h"

namespace phongpd {

class World;

// An obstacle that moves by itself: a part on a conveyor, another machine.  It
// translates.
struct MovingObstacle {
  Solid solid;  // where it is at the configuration 0; its name is the user's
  // From the time 0 on, at which the robot begins as well; afterwards it stays
  // where it came to.  User's unit, seconds.
  Trajectory motion;
};

// Throws InputError: an empty solid or motion, or a name that another of them
// has, or an obstacle of the world.
void RequireMoving(const World& world,
                   const std::vector<MovingObstacle>& moving);

// As the robot of the world meets them.  Their convolutions with the robot are
// kept by the world, one for all with the same mesh.  Throws like
// RequireMoving, and what ConvolutionModel throws.
std::vector<MovingBody> MovingBodies(const World& world,
                                     const std::vector<MovingObstacle>& moving);

// One sentence where the robot at q touches one of them at the time 0, on the
// solids; `which` is what q is called.  Empty: it touches none.  Builds
// nothing.
std::string MovingAtStart(const World& world,
                          const std::vector<MovingObstacle>& moving,
                          const Eigen::Vector3d& q, const std::string& which);

// One sentence where one of them has its last place on q; the same.
std::string MovingAtEnd(const World& world,
                        const std::vector<MovingObstacle>& moving,
                        const Eigen::Vector3d& q, const std::string& which);

}  // namespace phongpd
