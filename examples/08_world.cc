// SPDX-License-Identifier: GPL-3.0-or-later
// 08_world ROBOT OBSTACLE: plan and optimise in a world, one call each.
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/solve/optimize.h>
#include <phongpd/planners/solve/plan.h>

#include <iostream>

using namespace phongpd;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const World world({ReadSolid(argv[1]), {ReadSolid(argv[2])}});
  const Eigen::Vector3d start(-1.0, 0.1, 0.0), goal(3.0, -0.1, 0.1);
  const PathAnswer plan = Plan(world, {start, goal});
  std::cout << "plan: " << ToString(plan.status) << ", length " << plan.length
            << '\n';
  const PathAnswer path = Optimize(world, {start, goal});
  std::cout << "optimize: " << ToString(path.status) << ", length "
            << path.length << ", clearance " << path.clearance << ", "
            << ToString(path.evidence.verification->verdict)
            << " on the solids\n";
  // In the back of the U: said before anything would be built.
  const PathAnswer none = Plan(world, {start, {0.4, 0.0, 0.0}});
  std::cout << ToString(none.status) << ": " << none.reason << '\n';
}
