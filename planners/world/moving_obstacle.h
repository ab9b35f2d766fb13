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
  Solid solid;  // at configuration 0, with the name that the user gave it
  // Its configurations from time 0 on, when the robot begins as well; after its
  // end the obstacle rests there.  User's unit, seconds.
  Trajectory motion;
};

// Throws InputError: an empty solid or motion, or a name that another of them
// has, or an obstacle of the world.
void RequireMoving(const World& world,
                   const std::vector<MovingObstacle>& moving);

// The obstacles as the world's robot meets them.  The world keeps their
// convolutions with the robot, one for all obstacles with the same mesh. Throws
// what RequireMoving and ConvolutionModel throw.
std::vector<MovingBody> MovingBodies(const World& world,
                                     const std::vector<MovingObstacle>& moving);

// One sentence if the robot at q touches one of them at time 0, by the solids;
// `which` names q in it.  Empty: it touches none.  Builds nothing.
std::string MovingAtStart(const World& world,
                          const std::vector<MovingObstacle>& moving,
                          const Eigen::Vector3d& q, const std::string& which);

// The same for the places where they come to rest.
std::string MovingAtEnd(const World& world,
                        const std::vector<MovingObstacle>& moving,
                        const Eigen::Vector3d& q, const std::string& which);

}  // namespace phongpd
