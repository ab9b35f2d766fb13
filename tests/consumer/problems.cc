// SPDX-License-Identifier: GPL-3.0-or-later
// A world: what is wrong with a goal, and a way around a box.
#include <phongpd/planners/exact/contact_surface_planner.h>
#include <phongpd/planners/world/world.h>

#include <iostream>

#include "boxes.h"

int main() {
  phongpd::Workspace workspace;
  workspace.robot = phongpd::MakeSolid(Box(0.5), "robot");
  workspace.obstacles = {phongpd::MakeSolid(Box(1.0), "box")};
  workspace.bounds = {Eigen::Vector3d::Constant(-4.0),
                      Eigen::Vector3d::Constant(4.0)};
  const phongpd::World world(workspace);
  const Eigen::Vector3d blocked(1.0, 0.1, 0.2);
  std::cout << world.Diagnose(blocked).Text("goal") << '\n';
  if (world.Diagnose(blocked).IsFree() || !world.Diagnose(kGoal).IsFree() ||
      world.Report().contact_spaces != 0) {
    return 1;
  }
  phongpd::RouteRequest request;
  request.clearance = world.Resolve(phongpd::Length::FromShare(0.01)).unit;
  const phongpd::ContactSurfacePlanner planner(world.Sealed());
  const phongpd::PlanResult result = planner.Plan(kStart, kGoal, request);
  std::cout << phongpd::ToString(result.status) << ", length " << result.length
            << ", clearance " << result.clearance << '\n';
  return result.length > kShortest && result.length < 2.0 * kShortest ? 0 : 1;
}
