// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/retraction_planner.h"

#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/RandomNumbers.h>

#include <typeinfo>
#include <utility>

#include "planners/ompl/contact_space_validity.h"

namespace phongpd {

namespace ob = ompl::base;
using Eigen::Vector3d;

RetractionPlanner::RetractionPlanner(const ob::SpaceInformationPtr& si,
                                     std::shared_ptr<const ContactModel> model,
                                     const std::string& name)
    : Planner(si, name), retraction_(std::move(model)) {
  specs_.recognizedGoal = ob::GOAL_SAMPLEABLE_REGION;
  setSeed(ompl::RNG().getLocalSeed());
  from_ = si_->allocState();
  to_ = si_->allocState();
  DeclareParams();
  addPlannerProgressProperty("samples INTEGER",
                             [this] { return std::to_string(samples_); });
  addPlannerProgressProperty("graph states INTEGER", [this] {
    return std::to_string(graph_.points().size());
  });
  addPlannerProgressProperty("retractions INTEGER", [this] {
    return std::to_string(scratch_.counters.retractions);
  });
  addPlannerProgressProperty("slides INTEGER",
                             [this] { return std::to_string(slides_.slides); });
}

RetractionPlanner::~RetractionPlanner() {
  FreeStates();
  si_->freeState(from_);
  si_->freeState(to_);
}

void RetractionPlanner::DeclareParams() {
  DeclareRetractionParams([this] { return retraction_.options(); },
                          [this](const RetractionOptions& options) {
                            setRetractionOptions(options);
                          },
                          &params_);
  params_.declareParam<std::string>(
      "local_planner",
      [this](const std::string& name) {
        local_planner_ = LocalPlannerFromString(name);
      },
      [this] { return ToString(local_planner_); });
  params_["local_planner"].setRangeSuggestion(LocalPlannerRange());
  params_.declareParam<unsigned int>(
      "seed", [this](unsigned int seed) { setSeed(seed); },
      [this] { return seed_; });
  params_["seed"].setRangeSuggestion("1:1:4294967295");
}

void RetractionPlanner::setRetractionOptions(const RetractionOptions& options) {
  retraction_ = retraction_.WithOptions(options);
}

void RetractionPlanner::setSeed(std::uint64_t seed) {
  seed_ = static_cast<std::uint32_t>(seed);
  random_.seed(seed);
}

void RetractionPlanner::checkValidity() {
  Planner::checkValidity();
  CheckConfigurationSpace(getName(), *si_->getStateSpace());
  // Not one derived from it, which may ask for more.
  const ob::MotionValidator& validator = *si_->getMotionValidator();
  exact_ = typeid(validator) == typeid(ContactSpaceMotionValidator) &&
           static_cast<const ContactSpaceMotionValidator&>(validator)
                   .domain()
                   .free_space.get() == &retraction_.model().free_space();
}

void RetractionPlanner::clear() {
  Planner::clear();
  FreeStates();
  graph_.Clear();
  starts_.clear();
  goals_.clear();
  targets_.clear();
  samples_ = 0;
  samples_at_points_.clear();
  scratch_ = {};
  slides_ = {};
  ClearNeighbors();
}

void RetractionPlanner::FreeStates() {
  for (ob::State* state : states_) si_->freeState(state);
  states_.clear();
}

void RetractionPlanner::AddInputs(const ob::PlannerTerminationCondition& ptc) {
  while (const ob::State* state = pis_.nextStart()) {
    starts_.push_back(AddPoint(ToPoint(state)));
    AddRoot(starts_.back(), true);
  }
  // One goal is waited for, further ones come with the samples, as many as
  // there are doublings of these.
  if (goals_.empty() && !starts_.empty()) {
    if (const ob::State* state = pis_.nextGoal(ptc)) {
      goals_.push_back(AddPoint(ToPoint(state)));
      AddRoot(goals_.back(), false);
    }
  } else if (!goals_.empty() && samples_ >> goals_.size() > 0 &&
             pis_.haveMoreGoalStates()) {
    if (const ob::State* state = pis_.nextGoal()) {
      goals_.push_back(AddPoint(ToPoint(state)));
      AddRoot(goals_.back(), false);
    }
  }
}

ob::PlannerStatus RetractionPlanner::solve(
    const ob::PlannerTerminationCondition& ptc) {
  checkValidity();
  const auto* goal =
      dynamic_cast<const ob::GoalSampleableRegion*>(pdef_->getGoal().get());
  if (goal == nullptr) return ob::PlannerStatus::UNRECOGNIZED_GOAL_TYPE;
  AddInputs(ptc);
  if (starts_.empty()) return ob::PlannerStatus::INVALID_START;
  if (goals_.empty()) return ob::PlannerStatus::INVALID_GOAL;

  const BoundingBox region = retraction_.model().region();
  while (!AddSolution()) {
    if (ptc) return ob::PlannerStatus::TIMEOUT;
    if (targets_.empty()) {
      AddInputs(ptc);
      ++samples_;
      retraction_.Retract(UniformPoint(region, &random_), &random_, &scratch_);
      for (const RetractedPoint& point : scratch_.points) {
        targets_.push_back(point.q);
      }
      continue;
    }
    const Vector3d target = targets_.back();
    targets_.pop_back();
    Grow(target, ptc);
  }
  return ob::PlannerStatus::EXACT_SOLUTION;
}

bool RetractionPlanner::AddSolution() {
  for (const int start : starts_) {
    for (const int goal : goals_) {
      if (!graph_.AreConnected(start, goal)) continue;
      auto path = std::make_shared<ompl::geometric::PathGeometric>(si_);
      for (const Vector3d& q : graph_.ShortestPath(start, goal)) {
        FromPoint(q, from_);
        path->append(from_);
      }
      pdef_->addSolutionPath(path, false, 0.0, getName());
      return true;
    }
  }
  return false;
}

bool RetractionPlanner::Slide(int from, const Vector3d& to) {
  const Vector3d a = graph_.points()[static_cast<std::size_t>(from)];
  SlideStatus status = SlideStatus::kStopped;
  switch (local_planner_) {
    case LocalPlanner::kCollideAndSlide:
      status =
          CollideAndSlide(retraction_.model(), retraction_.options().clearance,
                          a, to, &path_, &slides_);
      break;
    case LocalPlanner::kStepRetract:
      status = StepRetract(retraction_, a, to, &random_, &scratch_, &path_,
                           &slides_);
      break;
    case LocalPlanner::kStraight:
      ++slides_.slides;
      ++slides_.segment_checks;
      path_.assign(1, a);
      if (retraction_.model().free_space().IsFree(a, to)) {
        path_.push_back(to);
        status = SlideStatus::kReached;
      }
      break;
  }
  for (std::size_t k = 1; !exact_ && k < path_.size(); ++k) {
    FromPoint(path_[k - 1], from_);
    FromPoint(path_[k], to_);
    if (si_->checkMotion(from_, to_)) continue;
    path_.resize(k);
    status = SlideStatus::kStopped;
  }
  return status == SlideStatus::kReached;
}

int RetractionPlanner::AddSlide(int from, int to) {
  const int last = graph_.AddPath(from, path_, to);
  samples_at_points_.resize(graph_.points().size(), samples_);
  return last;
}

int RetractionPlanner::AddPoint(const Vector3d& q) {
  samples_at_points_.push_back(samples_);
  return graph_.AddPoint(q);
}

void RetractionPlanner::getPlannerData(ob::PlannerData& data) const {
  Planner::getPlannerData(data);
  const std::vector<Vector3d>& points = graph_.points();
  while (states_.size() < points.size()) {
    states_.push_back(si_->allocState());
    FromPoint(points[states_.size() - 1], states_.back());
  }
  const auto state = [&](int point) {
    return states_[static_cast<std::size_t>(point)];
  };
  for (const int start : starts_) {
    data.addStartVertex(ob::PlannerDataVertex(state(start)));
  }
  for (const int goal : goals_) {
    data.addGoalVertex(ob::PlannerDataVertex(state(goal)));
  }
  for (ob::State* vertex : states_)
    data.addVertex(ob::PlannerDataVertex(vertex));
  for (const auto& [a, b] : graph_.edges()) {
    data.addEdge(ob::PlannerDataVertex(state(a)),
                 ob::PlannerDataVertex(state(b)));
  }
}

}  // namespace phongpd
