// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/ompl_planning.h"

#include <ompl/base/PlannerData.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/samplers/BridgeTestValidStateSampler.h>
#include <ompl/base/samplers/GaussianValidStateSampler.h>
#include <ompl/base/samplers/ObstacleBasedValidStateSampler.h>
#include <ompl/config.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>

#include "core/mesh/finite.h"
#include "core/mesh/mesh_error.h"
#include "core/stopwatch.h"
#include "planners/ompl/contact_space_validity.h"
#include "planners/ompl/ompl_planners.h"
#include "planners/ompl/retraction_forest.h"
#include "planners/ompl/retraction_rrt.h"
#include "planners/ompl/retraction_state_sampler.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::Vector3d;

template <typename Sampler>
ob::ValidStateSamplerPtr Allocate(const ob::SpaceInformation* si) {
  return std::make_shared<Sampler>(si);
}

// Does it ask for the contact surface?
bool NeedsSurface(const std::string& name) {
  return name.find("retraction") != std::string::npos;
}

void CheckIsAmong(const std::vector<std::string>& names,
                  const std::string& name) {
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  std::string list;
  for (const std::string& known : names) {
    list += (list.empty() ? "" : ", ") + known;
  }
  throw InputError("planner: expected one of " + list + ", found '" + name +
                   "'");
}

ob::PlannerPtr Configured(const std::shared_ptr<RetractionPlanner>& planner,
                          const OmplPlanningOptions& options) {
  planner->setRetractionOptions(options.retraction);
  planner->setSeed(options.seed);
  return planner;
}

// OMPL logs an error when its generator is seeded a second time, but does it;
// planners made afterwards draw their seeds from the new sequence.
void SeedOmpl(std::uint64_t seed) {
  ompl::msg::OutputHandler* const handler = ompl::msg::getOutputHandler();
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(1 + seed % 0xfffffffeull));
  ompl::msg::useOutputHandler(handler);
}

std::vector<Vector3d> PointsOf(const ob::PathPtr& path) {
  std::vector<Vector3d> points;
  const auto* geometric = dynamic_cast<const og::PathGeometric*>(path.get());
  if (geometric == nullptr) return points;
  points.reserve(geometric->getStateCount());
  for (unsigned int k = 0; k < geometric->getStateCount(); ++k) {
    points.push_back(ToPoint(geometric->getState(k)));
  }
  return points;
}

GrownGraph GraphOf(const ob::PlannerData& data) {
  GrownGraph graph;
  std::vector<unsigned int> next;
  for (unsigned int v = 0; v < data.numVertices(); ++v) {
    graph.points.push_back(ToPoint(data.getVertex(v).getState()));
    data.getEdges(v, next);
    for (const unsigned int w : next) {
      // Roadmaps have each edge both ways.
      if (v > w && data.edgeExists(w, v)) continue;
      graph.edges.emplace_back(v, w);
    }
  }
  return graph;
}

void AddRetractionFigures(const RetractionPlanner& planner,
                          OmplPlanningResult* result) {
  const RetractionCounters& counters = planner.retractionCounters();
  result->samples = planner.samples();
  result->collision_checks += counters.queries;
  result->segment_checks += planner.slideCounters().segment_checks;
  result->retractions = counters.retractions;
  result->branch_ends = counters.branch_ends;
  result->graph = {planner.graph().points(), planner.graph().edges(),
                   planner.samplesAtPoints()};
}

}  // namespace

const std::vector<std::string>& OmplPlannerNames() {
  static const std::vector<std::string> names = {
      "retraction-rrt",     "retraction-forest",
      "rrt-connect",        "prm",
      "prm-obstacle-based", "prm-gaussian",
      "prm-bridge",         "prm-retraction"};
  return names;
}

std::vector<std::string> SurfaceFreePlannerNames() {
  std::vector<std::string> names = OmplPlannerNames();
  names.erase(std::remove_if(names.begin(), names.end(), NeedsSurface),
              names.end());
  return names;
}

void OmplPlanningOptions::Validate() const {
  // OMPL counts ticks in 64 bits.
  if (!(time_limit > 0.0 && time_limit <= 1e9)) {
    throw InputError("time limit: expected > 0 and ≤ 1e9 seconds, found " +
                     std::to_string(time_limit));
  }
  retraction.Validate();
}

void SetStartAndGoal(const Vector3d& start, const Vector3d& goal,
                     ob::ProblemDefinition* problem) {
  if (!IsFinite(start) || !IsFinite(goal)) {
    throw InputError(
        "start and goal: expected finite coordinates, found NaN or Inf");
  }
  const ob::SpaceInformationPtr& si = problem->getSpaceInformation();
  ob::ScopedState<> from(si), to(si);
  FromPoint(start, from.get());
  FromPoint(goal, to.get());
  problem->setStartAndGoalStates(from, to);
}

ob::PlannerPtr MakeOmplPlanner(const std::string& name,
                               const ob::SpaceInformationPtr& si,
                               const std::shared_ptr<const ContactModel>& model,
                               const OmplPlanningOptions& options) {
  CheckIsAmong(model ? OmplPlannerNames() : SurfaceFreePlannerNames(), name);
  options.Validate();
  if (name == "retraction-rrt") {
    return Configured(std::make_shared<RetractionRRT>(si, model), options);
  }
  if (name == "retraction-forest") {
    return Configured(std::make_shared<RetractionForest>(si, model), options);
  }
  if (name == "rrt-connect") return std::make_shared<og::RRTConnect>(si);
  si->clearValidStateSamplerAllocator();
  if (name == "prm-obstacle-based") {
    si->setValidStateSamplerAllocator(
        Allocate<ob::ObstacleBasedValidStateSampler>);
  } else if (name == "prm-gaussian") {
    si->setValidStateSamplerAllocator(Allocate<ob::GaussianValidStateSampler>);
  } else if (name == "prm-bridge") {
    si->setValidStateSamplerAllocator(
        Allocate<ob::BridgeTestValidStateSampler>);
  } else if (name == "prm-retraction") {
    si->setValidStateSamplerAllocator(RetractionStateSamplerAllocator(
        model, options.retraction, options.seed));
  }
  return std::make_shared<og::PRM>(si);
}

namespace {

OmplPlanningResult Plan(const MotionDomain& domain,
                        const std::shared_ptr<const ContactModel>& model,
                        const Vector3d& start, const Vector3d& goal,
                        const std::string& name,
                        const OmplPlanningOptions& options) {
  SeedOmpl(options.seed);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(domain);
  const ob::PlannerPtr planner = MakeOmplPlanner(name, si, model, options);
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  SetStartAndGoal(start, goal, problem.get());
  planner->setProblemDefinition(problem);
  planner->setup();

  OmplPlanningResult result;
  // OMPL's planners wait for another goal until the time is over.
  for (const bool at_start : {true, false}) {
    if (domain.free_space->IsFree(at_start ? start : goal)) continue;
    result.status =
        ob::PlannerStatus(at_start ? ob::PlannerStatus::INVALID_START
                                   : ob::PlannerStatus::INVALID_GOAL)
            .asString();
    return result;
  }
  const auto* own = dynamic_cast<const RetractionPlanner*>(planner.get());
  const Stopwatch stopwatch;
  const ob::PlannerStatus status =
      planner->solve(ob::timedPlannerTerminationCondition(options.time_limit));
  result.seconds = stopwatch.Seconds();
  result.status = status.asString();
  result.solved = status == ob::PlannerStatus::EXACT_SOLUTION;
  result.collision_checks = static_cast<const ContactSpaceValidityChecker&>(
                                *si->getStateValidityChecker())
                                .checks();
  result.segment_checks = si->getMotionValidator()->getCheckedMotionCount();
  if (own != nullptr) {
    AddRetractionFigures(*own, &result);
  } else {
    ob::PlannerData data(si);
    planner->getPlannerData(data);
    result.graph = GraphOf(data);
  }
  if (result.solved) {
    result.path = PointsOf(problem->getSolutionPath());
    result.length = PathLength(result.path);
    result.collision_free = CheckPath(*domain.free_space, result.path).free;
    if (result.collision_free) {
      result.clearance = PathClearance(*domain.free_space, result.path);
    }
  }
  return result;
}

}  // namespace

OmplPlanningResult PlanWithOmpl(
    const std::shared_ptr<const ContactModel>& model, const Vector3d& start,
    const Vector3d& goal, const std::string& name,
    const OmplPlanningOptions& options) {
  if (!model) throw InputError("planner: expected a contact model, found none");
  return Plan(DomainOf(model), model, start, goal, name, options);
}

OmplPlanningResult PlanWithOmpl(const MotionDomain& domain,
                                const Vector3d& start, const Vector3d& goal,
                                const std::string& name,
                                const OmplPlanningOptions& options) {
  return Plan(domain, nullptr, start, goal, name, options);
}

// OMPL_VERSION is empty in Debian's package.
std::string OmplVersion() {
  return std::to_string(OMPL_MAJOR_VERSION) + '.' +
         std::to_string(OMPL_MINOR_VERSION) + '.' +
         std::to_string(OMPL_PATCH_VERSION);
}

void SilenceOmpl() { ompl::msg::noOutputHandler(); }

}  // namespace phongpd
