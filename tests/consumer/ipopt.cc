// SPDX-License-Identifier: GPL-3.0-or-later
// A trajectory around a box.
#include <phongpd/planners/trajectory/trajectory_pipeline.h>

#include <iostream>

#include "boxes.h"

int main() {
  const phongpd::ContactSpace contact = BoxSpace();
  phongpd::TrajectoryProblem problem =
      phongpd::MakeTrajectoryProblem({contact});
  problem.start = kStart;
  problem.goal = kGoal;
  const phongpd::TrajectoryPipeline pipeline(
      problem, std::make_shared<phongpd::StartRepair>(contact));
  const phongpd::PipelineResult result = pipeline.Solve();
  const double length = phongpd::PathLength(result.path);
  std::cout << phongpd::ToString(result.status) << ", length " << length
            << '\n';
  return result.certificate.free && length > kShortest &&
                 length < 2.0 * kShortest
             ? 0
             : 1;
}
