// SPDX-License-Identifier: GPL-3.0-or-later
// 07_motion ROBOT OBSTACLE: a motion that a machine can follow, by way of a
// place at which it rests; free and within limits for all t, proved.
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/solve/optimize.h>

#include <iostream>

using namespace phongpd;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const World world({ReadSolid(argv[1]),
                     {ReadSolid(argv[2])},
                     {{-1.0, -1.0, -0.6}, {3.0, 3.0, 0.6}}});
  OptimizeRequest request;
  request.start = {1.5, 1.0, 0.0};
  request.goal = {-0.8, 1.0, 0.0};
  request.via = {{{2.6, 0.25, 0.0}, Length::FromUnit(0.01), 0.5}};
  request.limits.emplace();
  request.limits->velocity.setConstant(1.0);
  request.limits->acceleration.setConstant(2.0);
  request.limits->jerk.setConstant(10.0);
  const PathAnswer answer = Optimize(world, request);

  std::cout << ToString(answer.status) << ": " << answer.motion.duration()
            << " s, " << answer.curve->stops_duration
            << " s with stops at corners; clearance " << answer.clearance
            << " at least\n";
  if (answer.motion.empty()) return 1;
  for (const Trajectory::Sample& s : answer.motion.Samples(5.0)) {
    std::cout << s.time << ": at " << s.position.transpose() << ", speed "
              << s.velocity.norm() << '\n';
  }
}
