// SPDX-License-Identifier: GPL-3.0-or-later
// A program of OMPL's that takes a planner from here.
#include <ompl/base/ScopedState.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/util/RandomNumbers.h>
#include <phongpd/planners/ompl/contact_space_validity.h>
#include <phongpd/planners/ompl/retraction_rrt.h>

#include <iostream>

#include "boxes.h"

int main() {
  ompl::RNG::setSeed(1);
  const auto model = std::make_shared<const phongpd::ContactModel>(
      std::vector<phongpd::ContactSpace>{BoxSpace()},
      phongpd::BoundingBox{Eigen::Vector3d::Constant(-4.0),
                           Eigen::Vector3d::Constant(4.0)});
  const auto si = phongpd::MakeSpaceInformation(model);
  ompl::geometric::SimpleSetup setup(si);
  ompl::base::ScopedState<> start(si), goal(si);
  phongpd::FromPoint(kStart, start.get());
  phongpd::FromPoint(kGoal, goal.get());
  setup.setStartAndGoalStates(start, goal);
  setup.setPlanner(std::make_shared<phongpd::RetractionRRT>(si, model));
  const ompl::base::PlannerStatus status = setup.solve(30.0);
  if (status != ompl::base::PlannerStatus::EXACT_SOLUTION) return 1;
  std::vector<Eigen::Vector3d> path;
  for (const ompl::base::State* state : setup.getSolutionPath().getStates()) {
    path.push_back(phongpd::ToPoint(state));
  }
  const double length = phongpd::PathLength(path);
  std::cout << status.asString() << ", length " << length << '\n';
  // A random tree promises a free path, not a short one.
  return phongpd::CheckPath(model->free_space(), path).free &&
                 length > kShortest
             ? 0
             : 1;
}
