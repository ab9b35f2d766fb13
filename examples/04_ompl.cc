// SPDX-License-Identifier: GPL-3.0-or-later
// 04_ompl ROBOT OBSTACLE: a planner of OMPL's that answers exactly: there is
// a path around the U, and with bounds that leave no room beside it none, which
// is proved.
#include <ompl/base/ScopedState.h>
#include <ompl/geometric/SimpleSetup.h>
#include <phongpd/core/contact/contact_space.h>
#include <phongpd/core/solid/solid.h>
#include <phongpd/planners/ompl/contact_space_validity.h>
#include <phongpd/planners/ompl/contact_surface_ompl_planner.h>
#include <phongpd/planners/world/workspace.h>

#include <iostream>

using Eigen::Vector3d;

namespace {

void Solve(const char* name, const phongpd::Workspace& workspace,
           const Vector3d& from, const Vector3d& to) {
  // One contact space of all obstacles and the bounds.
  const phongpd::ContactSpace space = phongpd::BuildContactSpace(
      workspace.robot, phongpd::MergedObstacle(workspace));
  const auto model = std::make_shared<const phongpd::ContactModel>(
      std::vector<phongpd::ContactSpace>{space}, workspace.bounds);
  const auto si = phongpd::MakeSpaceInformation(model);
  const auto planner = std::make_shared<phongpd::ContactSurfaceOmplPlanner>(
      si, std::make_shared<phongpd::ContactSurfacePlanner>(space));

  ompl::geometric::SimpleSetup setup(si);
  ompl::base::ScopedState<> start(si), goal(si);
  phongpd::FromPoint(from, start.get());
  phongpd::FromPoint(to, goal.get());
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(planner);
  std::cout << name << ": ";
  if (setup.solve(1.0) == ompl::base::PlannerStatus::EXACT_SOLUTION) {
    std::cout << "length " << setup.getSolutionPath().length() << '\n';
  } else {  // OMPL has no status for a proof
    std::cout << "no path, "
              << (planner->infeasibleProved() ? "proved" : planner->reason())
              << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  phongpd::Workspace workspace{phongpd::ReadSolid(argv[1]),
                               {phongpd::ReadSolid(argv[2])},
                               {{-1.0, -1.0, -0.6}, {3.0, 3.0, 0.6}}};
  const Vector3d left(-0.8, 1.0, 0.0), gap(1.5, 1.0, 0.0);
  Solve("around the U", workspace, left, gap);
  workspace.bounds = {{-1.0, 0.0, -0.6}, {3.0, 2.0, 0.6}};
  Solve("no way around", workspace, left, gap);
}
