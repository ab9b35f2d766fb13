// SPDX-License-Identifier: GPL-3.0-or-later
// 03_ipopt ROBOT OBSTACLE: a short, smooth trajectory: start repaired, Ipopt on
// rows d ≥ margin, judged exactly on the whole swept path.  Step by step; all
// of it in one call is in 08_world.
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/trajectory/trajectory_pipeline.h>
#include <phongpd/planners/world/world.h>

#include <iostream>

using namespace phongpd;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const World world({ReadSolid(argv[1]), {ReadSolid(argv[2])}});
  TrajectoryProblem problem = TrajectoryProblemIn(world);
  problem.start = {-1.0, 0.1, 0.0};
  problem.goal = {3.0, -0.1, 0.1};
  const PipelineResult result = TrajectoryPipeline(world, problem).Solve();

  std::cout << ToString(result.status) << ", objective " << result.objective
            << ", the judge says "
            << (result.certificate.free ? "free" : "not free") << '\n';
  for (const StageRecord& stage : result.stages) {
    std::cout << "  " << stage.stage << ": " << stage.status << ", objective "
              << stage.objective << '\n';
  }
}
