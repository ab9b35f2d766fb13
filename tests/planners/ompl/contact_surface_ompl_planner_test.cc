// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/ompl/contact_surface_ompl_planner.h"

#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/geometric/PathGeometric.h>

#include <random>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/contact_space_validity.h"
#include "tests/support/campaign.h"
#include "tests/support/lattice_world.h"
#include "tests/support/passages.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;

struct Query {
  explicit Query(const testing::Passage& passage)
      : si(MakeSpaceInformation(passage.model)),
        problem(std::make_shared<ob::ProblemDefinition>(si)),
        planner(std::make_shared<ContactSurfaceOmplPlanner>(
            si, std::make_shared<const ContactSurfacePlanner>(
                    passage.model->space(0)))) {
    ob::ScopedState<> start(si), goal(si);
    FromPoint(passage.scene.start, start.get());
    FromPoint(passage.scene.goal, goal.get());
    problem->setStartAndGoalStates(start, goal);
    planner->setProblemDefinition(problem);
    planner->setup();
  }

  ob::SpaceInformationPtr si;
  ob::ProblemDefinitionPtr problem;
  std::shared_ptr<ContactSurfaceOmplPlanner> planner;
};

TEST(ContactSurfaceOmplPlanner, SolvesOrProvesThereIsNoPath) {
  for (const char* family : {"hole", "tunnel", "keyhole", "bugtrap"}) {
    for (const int turned : {0, 1}) {
      Query feasible(testing::MakePassage(family, 1e-3, turned));
      EXPECT_EQ(feasible.planner->solve(1.0), ob::PlannerStatus::EXACT_SOLUTION)
          << family << turned;
      EXPECT_TRUE(feasible.problem->getSolutionPath()->check());
      EXPECT_FALSE(feasible.planner->infeasibleProved());
      Query twin(testing::MakePassage(family, -1e-4, turned));
      EXPECT_EQ(twin.planner->solve(1.0), ob::PlannerStatus::ABORT)
          << family << turned;
      EXPECT_TRUE(twin.planner->infeasibleProved());
      EXPECT_FALSE(twin.problem->hasSolution());
    }
  }
}

// Round numbers; flood fill knows the answer.
TEST(LatticeCampaign, OmplAnswersEveryQueryRight) {
  testing::CampaignRow row;
  row.item = "lattice";
  row.subject = "planner of OMPL";
  const int worlds = static_cast<int>(testing::CampaignCases(10, 100));
  for (int i = 0; i < worlds; ++i) {
    std::mt19937_64 random(static_cast<std::uint64_t>(i));
    const auto world =
        testing::MakeLatticeWorld(static_cast<testing::LatticeWorld::Family>(
                                      i % testing::LatticeWorld::kFamilies),
                                  i % 2 == 1, &random);
    BoundingBox region = ComputeBounds(world.contact_space);
    region.max += Eigen::Vector3d::Constant(region.Diagonal());
    region.min -= Eigen::Vector3d::Constant(region.Diagonal());
    const auto si = MakeSpaceInformation(std::make_shared<const ContactModel>(
        std::vector<ContactSpace>{TakeAsContactSpace(world.contact_space)},
        region));
    ContactSurfaceOmplPlanner planner(
        si, std::make_shared<const ContactSurfacePlanner>(
                TakeAsContactSpace(world.contact_space)));
    planner.setRoadmap(i % 3 == 0);
    const auto pick = [&](ob::ScopedState<>* state) {
      testing::LatticeWorld::Cell cell = world.RandomCell(&random);
      while (world.Label(cell) < 0) cell = world.RandomCell(&random);
      FromPoint(world.Point(cell), state->get());
      return world.Label(cell);
    };
    for (long k = testing::CampaignCases(10, 100); k > 0; --k) {
      ob::ScopedState<> start(si), goal(si);
      const bool connected = pick(&start) == pick(&goal);
      const auto problem = std::make_shared<ob::ProblemDefinition>(si);
      problem->setStartAndGoalStates(start, goal);
      planner.clear();
      planner.setProblemDefinition(problem);
      planner.setup();
      const bool solved =
          planner.solve(1.0) == ob::PlannerStatus::EXACT_SOLUTION;
      ++row.cases;
      row.failures +=
          solved != connected || (solved ? !problem->getSolutionPath()->check()
                                         : !planner.infeasibleProved());
    }
  }
  EXPECT_EQ(row.failures, 0);
  testing::ReportCampaign(row);
}

TEST(ContactSurfaceOmplPlanner, IsAPlannerLikeOthers) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-3);
  Query query(passage);
  EXPECT_TRUE(query.planner->getSpecs().provingSolutionNonExistence);
  ASSERT_TRUE(query.planner->solve(1.0));
  const auto* path =
      query.problem->getSolutionPath()->as<ompl::geometric::PathGeometric>();
  ob::PlannerData data(query.si);
  query.planner->getPlannerData(data);
  EXPECT_EQ(data.numVertices(), path->getStateCount());
  EXPECT_EQ(data.numEdges() + 1, data.numVertices());
  EXPECT_EQ(data.numStartVertices(), 1u);
  EXPECT_EQ(data.numGoalVertices(), 1u);
  query.planner->clear();
  query.problem->clearSolutionPaths();
  EXPECT_TRUE(query.planner->solve(1.0));
  EXPECT_EQ(query.planner->getPlannerProgressProperties().count(
                "infeasible proved BOOLEAN"),
            1u);
  EXPECT_THROW(ContactSurfaceOmplPlanner(query.si, nullptr), InputError);
}

TEST(ContactSurfaceOmplPlanner, KeepsItsRoadmapFromQueryToQuery) {
  const testing::Passage passage = testing::MakePassage("keyhole", 1e-3);
  Query query(passage);
  EXPECT_EQ(query.planner->params()["roadmap"].getValue(), "0");
  query.planner->params().setParam("roadmap", "1");
  EXPECT_TRUE(query.planner->getRoadmap());
  EXPECT_EQ(query.planner->roadmap(), nullptr);
  const ContactRoadmap* built = nullptr;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(query.planner->solve(1.0), ob::PlannerStatus::EXACT_SOLUTION);
    EXPECT_TRUE(query.problem->getSolutionPath()->check());
    EXPECT_EQ(query.planner->result().searches, 0);
    if (i == 0) built = query.planner->roadmap();
    EXPECT_EQ(query.planner->roadmap(), built);
    EXPECT_EQ(query.planner->roadmap()->report().queries, i + 1);
    query.planner->clear();
    query.problem->clearSolutionPaths();
  }
  Query twin(testing::MakePassage("keyhole", -1e-4));
  twin.planner->setRoadmap(true);
  EXPECT_EQ(twin.planner->solve(1.0), ob::PlannerStatus::ABORT);
  EXPECT_TRUE(twin.planner->infeasibleProved());
}

TEST(ContactSurfaceOmplPlanner, TriesEveryGoal) {
  const testing::Passage passage = testing::MakePassage("hole", -1e-4);
  Query query(passage);
  auto goals = std::make_shared<ob::GoalStates>(query.si);
  ob::ScopedState<> state(query.si);
  FromPoint(passage.scene.goal, state.get());
  goals->addState(state);
  FromPoint(passage.scene.start + Eigen::Vector3d(0.0, 0.2, 0.1), state.get());
  goals->addState(state);
  query.problem->setGoal(goals);
  EXPECT_EQ(query.planner->solve(1.0), ob::PlannerStatus::EXACT_SOLUTION);
}

}  // namespace
}  // namespace phongpd
