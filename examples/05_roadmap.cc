// SPDX-License-Identifier: GPL-3.0-or-later
// 05_roadmap ROBOT OBSTACLE: many queries in one scene.  The roadmap is built
// once; an answer is a path that is free by exact tests, or a proof that there
// is none.
#include <phongpd/core/contact/contact_space.h>
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/exact/contact_roadmap.h>
#include <phongpd/planners/world/workspace.h>

#include <iostream>
#include <map>
#include <random>
#include <string>

using Eigen::Vector3d;

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const phongpd::Workspace workspace{phongpd::ReadSolid(argv[1]),
                                     {phongpd::ReadSolid(argv[2])},
                                     {{-1.0, -1.0, -0.6}, {3.0, 3.0, 0.6}}};
  const phongpd::ContactSpace space = phongpd::BuildContactSpace(
      workspace.robot, phongpd::MergedObstacle(workspace));
  const phongpd::ContactRoadmap roadmap(space);
  const phongpd::RoadmapReport built = roadmap.report();
  std::cout << built.nodes << " nodes, " << built.edges << " edges\n";

  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto draw = [&] {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Vector3d(workspace.bounds.min.array() +
                    Eigen::Array3d(x, y, z) *
                        (workspace.bounds.max - workspace.bounds.min).array());
  };
  std::map<std::string, int> answers;
  double length = 0.0, straight = 0.0, seconds = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d start = draw(), goal = draw();
    const phongpd::PlanResult plan = roadmap.Plan(start, goal);
    ++answers[phongpd::ToString(plan.status)];
    seconds += plan.seconds;
    if (plan.status != phongpd::PathStatus::kSolved) continue;
    length += plan.length;
    straight += (goal - start).norm();
  }
  for (const auto& [status, count] : answers) {
    std::cout << count << ' ' << status << '\n';
  }
  std::cout << "paths are " << length / straight
            << " times as long as straight lines\n";
  std::cerr << 1e3 * seconds / 500 << " ms a query\n";
}
