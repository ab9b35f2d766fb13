// SPDX-License-Identifier: GPL-3.0-or-later
// 03_ipopt SCENE: a short, smooth trajectory of a scene file: start repaired,
// Ipopt on rows d ≥ margin, judged exactly on the whole swept path.
#include <phongpd/planners/trajectory/trajectory_pipeline.h>
#include <phongpd/problems/scenes/scene.h>
#include <phongpd/problems/studies/trajectory_study.h>

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 03_ipopt SCENE\n";
    return 2;
  }
  try {
    const phongpd::Scene scene = phongpd::ReadScene(argv[1]);
    phongpd::TrajectoryStudy study;
    study.Enter(scene);  // builds nothing: Run does, once for all runs
    const phongpd::PipelineResult result = study.Run(
        phongpd::SceneMetric(scene), phongpd::ScenePipelineOptions(scene));

    std::cout << phongpd::ToString(result.status) << ", objective "
              << result.objective << ", the judge says "
              << (result.certificate.free ? "free" : "not free") << '\n';
    for (const phongpd::StageRecord& stage : result.stages) {
      std::cout << "  " << stage.stage << ": " << stage.status << ", objective "
                << stage.objective << '\n';
    }
    std::cerr << result.seconds << " s\n";
  } catch (const std::exception& error) {  // one line: what, where, how to mend
    std::cerr << error.what() << '\n';
    return 2;
  }
}
