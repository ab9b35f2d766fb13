// SPDX-License-Identifier: GPL-3.0-or-later
// One call: a way around a box.
#include <phongpd/planners/solve/optimize.h>
#include <phongpd/planners/solve/plan.h>

#include <iostream>

#include "boxes.h"

int main() {
  phongpd::Workspace workspace;
  workspace.robot = phongpd::MakeSolid(Box(0.5), "robot");
  workspace.obstacles = {phongpd::MakeSolid(Box(1.0), "box")};
  const phongpd::World world(workspace);
  const phongpd::PathAnswer plan = phongpd::Plan(world, {kStart, kGoal});
  const phongpd::PathAnswer path = phongpd::Optimize(world, {kStart, kGoal});
  std::cout << phongpd::ToString(plan.status) << ", length " << plan.length
            << "; " << phongpd::ToString(path.status) << ", length "
            << path.length << '\n';
  return plan.is_solved && path.is_solved && plan.length > kShortest &&
                 path.length > kShortest && path.length < 2.0 * kShortest
             ? 0
             : 1;
}
