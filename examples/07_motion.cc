// SPDX-License-Identifier: GPL-3.0-or-later
// 07_motion ROBOT OBSTACLE: a motion that a machine can follow, by way of a
// place at which it rests; free and within limits for all t, proved.
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/exact/contact_surface_planner.h>
#include <phongpd/planners/trajectory/curve_optimizer.h>
#include <phongpd/planners/world/world.h>

#include <iostream>
#include <vector>

using namespace phongpd;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const World world({ReadSolid(argv[1]),
                     {ReadSolid(argv[2])},
                     {{-1.0, -1.0, -0.6}, {3.0, 3.0, 0.6}}});
  const std::vector<Eigen::Vector3d> places = {
      {1.5, 1.0, 0.0}, {2.6, 0.25, 0.0}, {-0.8, 1.0, 0.0}};
  const ContactSurfacePlanner planner(world.Sealed());
  std::vector<Eigen::Vector3d> path = {places[0]};
  for (int leg = 0; leg < 2; ++leg) {
    const PlanResult plan = planner.Plan(places[leg], places[leg + 1]);
    if (plan.status != PlanStatus::kSolved) return 1;
    path.insert(path.end(), plan.path.begin() + 1, plan.path.end());
  }
  CurveOptions options;
  options.limits.velocity.setConstant(1.0);
  options.limits.acceleration.setConstant(2.0);
  options.limits.jerk.setConstant(10.0);
  options.via = {{places[1], 0.01, 0.5}};
  const CurveSummary found =
      OptimizeCurve(*world.Spaces(SpaceLayout::kSealed).free_space,
                    world.diagonal(), path, options);
  std::cout << ToString(found.status) << ": " << found.duration << " s, "
            << found.stops_duration << " s with stops at corners; clearance "
            << found.clearance << " at least\n";
  for (const Trajectory::Sample& s : found.trajectory.Samples(5.0)) {
    std::cout << s.time << ": at " << s.position.transpose() << ", speed "
              << s.velocity.norm() << '\n';
  }
}
