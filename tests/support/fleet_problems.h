// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "planners/solve/fleet.h"
#include "tests/support/curve_problems.h"
#include "tests/support/solid_tools.h"

// Cubes of side 1 in an empty room, within PlainLimits.
namespace phongpd::testing {

inline World RoomOfCubes(const BoundingBox& bounds) {
  Workspace workspace;
  workspace.robot = MakeSolid(Cube(1.0), "robot");
  workspace.bounds = bounds;
  return World(workspace);
}

inline FleetRobot CubeRobot(const std::string& name, const World& world,
                            const Eigen::Vector3d& start,
                            const Eigen::Vector3d& goal) {
  OptimizeRequest request;
  request.start = start;
  request.goal = goal;
  request.margin = Length::FromUnit(0.01);
  request.preset = Preset::kFast;
  request.limits = PlainLimits();
  request.verifies = false;
  return {name, world, request};
}

}  // namespace phongpd::testing
