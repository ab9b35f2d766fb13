// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "planners/solve/optimize.h"

// What Optimize and Retime do where obstacles move; nothing where none does.
namespace phongpd::internal {

// Throws InputError for moving obstacles that RequireMoving refuses, without
// limits, for a given duration, and for ends in motion.
void RequireMovingRequest(const World& world, const OptimizeRequest& request);

// Does none of them begin on the start or end on the goal?  Otherwise the
// answer says which, and when; nothing is built.
bool AreEndsClear(const World& world, const OptimizeRequest& request,
                  const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                  PathAnswer* answer);

// Is what the answer says of its start or goal due to what moves?
bool IsBlockedByMoving(const World& world, const Eigen::Vector3d& start,
                       const Eigen::Vector3d& goal, const PathAnswer& answer);

// From certified motions among what is fixed, one for each path or empty, to
// one that is free of what moves (moving_motion.h), which replaces that of the
// answer; its clearance is a lower bound, up to the margin asked for.
void KeepOffMoving(const World& world, const OptimizeRequest& request,
                   const std::vector<Path>& paths,
                   const std::vector<Trajectory>& motions, PathAnswer* answer);

// If the answer was verified, on the solids: the relative motions are, too.
void VerifyAmongMoving(const World& world, const OptimizeRequest& request,
                       PathAnswer* answer);

}  // namespace phongpd::internal
