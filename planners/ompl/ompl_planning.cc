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
#include "core/minkowski/build_stop.h"
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

// Throws InputError for planners that are not made here, or not without a
// model.
void RequireOmplPlanner(PlannerId planner, bool has_model) {
  if (planner == PlannerId::kContactSurface) {
    throw InputError("planner: expected one of OMPL's or a retraction, found " +
                     std::string(ToString(planner)));
  }
  if (has_model || !Retracts(planner)) return;
  throw InputError(std::string("planner: expected a contact model with ") +
                   ToString(planner) + ", found none");
}

ob::PlannerPtr Configured(const std::shared_ptr<RetractionPlanner>& planner,
                          const OmplPlanningOptions& options) {
  planner->setRetractionOptions(options.retraction);
  planner->setSeed(options.seed);
  return planner;
}

// Of PRM; null: uniform samples.
ob::ValidStateSamplerAllocator SamplerOf(
    PlannerId planner, const std::shared_ptr<const ContactModel>& model,
    const OmplPlanningOptions& options) {
  switch (planner) {
    case PlannerId::kPrmObstacleBased:
      return Allocate<ob::ObstacleBasedValidStateSampler>;
    case PlannerId::kPrmGaussian:
      return Allocate<ob::GaussianValidStateSampler>;
    case PlannerId::kPrmBridge:
      return Allocate<ob::BridgeTestValidStateSampler>;
    case PlannerId::kPrmRetraction:
      return RetractionStateSamplerAllocator(model, options.retraction,
                                             options.seed);
    default:
      return nullptr;
  }
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

ob::PlannerPtr MakeOmplPlanner(PlannerId planner,
                               const ob::SpaceInformationPtr& si,
                               const std::shared_ptr<const ContactModel>& model,
                               const OmplPlanningOptions& options) {
  RequireOmplPlanner(planner, model != nullptr);
  options.Validate();
  switch (planner) {
    case PlannerId::kRetractionRrt:
      return Configured(std::make_shared<RetractionRRT>(si, model), options);
    case PlannerId::kRetractionForest:
      return Configured(std::make_shared<RetractionForest>(si, model), options);
    case PlannerId::kRrtConnect:
      return std::make_shared<og::RRTConnect>(si);
    default:
      break;
  }
  si->setValidStateSamplerAllocator(SamplerOf(planner, model, options));
  return std::make_shared<og::PRM>(si);
}

namespace {

OmplPlanningResult Plan(const MotionDomain& domain,
                        const std::shared_ptr<const ContactModel>& model,
                        const Vector3d& start, const Vector3d& goal,
                        PlannerId id, const OmplPlanningOptions& options) {
  SeedOmpl(options.seed);
  const ob::SpaceInformationPtr si = MakeSpaceInformation(domain);
  const ob::PlannerPtr planner = MakeOmplPlanner(id, si, model, options);
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
  const CancelWatch watch;
  const ob::PlannerStatus status =
      planner->solve(ob::plannerOrTerminationCondition(
          ob::timedPlannerTerminationCondition(options.time_limit),
          ob::PlannerTerminationCondition(
              [&watch] { return watch.IsCancelled(); })));
  watch.Check("the search of the sampler");
  result.seconds = stopwatch.Seconds();
  result.status = status.asString();
  result.solved = status == ob::PlannerStatus::EXACT_SOLUTION;
  result.is_late = status == ob::PlannerStatus::TIMEOUT ||
                   status == ob::PlannerStatus::APPROXIMATE_SOLUTION;
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
    const Vector3d& goal, PlannerId id, const OmplPlanningOptions& options) {
  if (!model) throw InputError("planner: expected a contact model, found none");
  return Plan(DomainOf(model), model, start, goal, id, options);
}

OmplPlanningResult PlanWithOmpl(const MotionDomain& domain,
                                const Vector3d& start, const Vector3d& goal,
                                PlannerId id,
                                const OmplPlanningOptions& options) {
  return Plan(domain, nullptr, start, goal, id, options);
}

// OMPL_VERSION is empty in Debian's package.
std::string OmplVersion() {
  return std::to_string(OMPL_MAJOR_VERSION) + '.' +
         std::to_string(OMPL_MINOR_VERSION) + '.' +
         std::to_string(OMPL_PATCH_VERSION);
}

void SilenceOmpl() { ompl::msg::noOutputHandler(); }

}  // namespace phongpd
