// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/contact_surface_ompl_planner.h"

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/PathGeometric.h>

#include <utility>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/contact_space_validity.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

ContactSurfaceOmplPlanner::ContactSurfaceOmplPlanner(
    const ob::SpaceInformationPtr& si,
    std::shared_ptr<const ContactSurfacePlanner> planner)
    : Planner(si, "ContactSurface"), planner_(std::move(planner)) {
  if (!planner_) {
    throw InputError("ContactSurface: expected a planner, found none");
  }
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  specs_.provingSolutionNonExistence = true;
  declareParam<bool>("roadmap", this, &ContactSurfaceOmplPlanner::setRoadmap,
                     &ContactSurfaceOmplPlanner::getRoadmap, "0,1");
  addPlannerProgressProperty("infeasible proved BOOLEAN", [this] {
    return std::to_string(static_cast<int>(infeasible_proved_));
  });
}

ContactSurfaceOmplPlanner::~ContactSurfaceOmplPlanner() {
  for (ob::State* state : path_) si_->freeState(state);
}

void ContactSurfaceOmplPlanner::clear() {
  Planner::clear();
  for (ob::State* state : path_) si_->freeState(state);
  path_.clear();
  starts_.clear();
  goals_.clear();
  result_ = {};
  infeasible_proved_ = false;
}

void ContactSurfaceOmplPlanner::checkValidity() {
  Planner::checkValidity();
  CheckConfigurationSpace(getName(), *si_->getStateSpace());
}

ob::PlannerStatus ContactSurfaceOmplPlanner::solve(
    const ob::PlannerTerminationCondition& ptc) {
  checkValidity();
  const auto* goal =
      dynamic_cast<const ob::GoalSampleableRegion*>(pdef_->getGoal().get());
  if (goal == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  while (const ob::State* state = pis_.nextStart()) {
    starts_.push_back(ToPoint(state));
  }
  if (starts_.empty()) return ob::PlannerStatus::INVALID_START;
  bool all_proved = true;
  for (bool waits = goals_.empty(); waits || pis_.haveMoreGoalStates();
       waits = false) {
    const ob::State* state = waits ? pis_.nextGoal(ptc) : pis_.nextGoal();
    if (state == nullptr) break;
    goals_.push_back(ToPoint(state));
    for (const Vector3d& start : starts_) {
      if (ptc && goals_.size() > 1) return ob::PlannerStatus::TIMEOUT;
      result_ = Plan(start, goals_.back());
      all_proved &= result_.status == PathStatus::kInfeasibleProved;
      if (result_.status != PathStatus::kSolved) continue;
      if (AddSolution()) return ob::PlannerStatus::EXACT_SOLUTION;
      result_.reason = "the path is not valid for the space information";
    }
  }
  if (goals_.empty()) return ob::PlannerStatus::INVALID_GOAL;
  // A goal region of which every state has been seen.
  infeasible_proved_ = all_proved && goals_.size() >= goal->maxSampleCount();
  return ob::PlannerStatus::ABORT;
}

PlanResult ContactSurfaceOmplPlanner::Plan(const Vector3d& start,
                                           const Vector3d& goal) {
  if (!uses_roadmap_) return planner_->Plan(start, goal);
  if (!roadmap_) roadmap_ = std::make_unique<const ContactRoadmap>(planner_);
  return roadmap_->Plan(start, goal);
}

bool ContactSurfaceOmplPlanner::AddSolution() {
  for (ob::State* state : path_) si_->freeState(state);
  path_.clear();
  for (const Vector3d& q : result_.path) {
    path_.push_back(si_->allocState());
    FromPoint(q, path_.back());
  }
  auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
  for (const ob::State* state : path_) path->append(state);
  if (!path->check()) return false;
  pdef_->addSolutionPath(path, false, 0.0, getName());
  return true;
}

void ContactSurfaceOmplPlanner::getPlannerData(ob::PlannerData& data) const {
  Planner::getPlannerData(data);
  for (std::size_t k = 0; k < path_.size(); ++k) {
    const ob::PlannerDataVertex vertex(path_[k]);
    if (k == 0) {
      data.addStartVertex(vertex);
    } else if (k + 1 == path_.size()) {
      data.addGoalVertex(vertex);
    } else {
      data.addVertex(vertex);
    }
    if (k > 0) data.addEdge(ob::PlannerDataVertex(path_[k - 1]), vertex);
  }
}

}  // namespace phongpd
