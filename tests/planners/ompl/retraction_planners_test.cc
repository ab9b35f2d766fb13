// SPDX-License-Identifier: GPL-3.0-or-later
// RetractionRRT and RetractionForest as planners of OMPL.
// Truth: the exact path check, infeasible twins, repetition.
#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <thread>

#include "core/mesh/mesh_error.h"
#include "planners/ompl/contact_space_validity.h"
#include "planners/ompl/retraction_forest.h"
#include "planners/ompl/retraction_rrt.h"
#include "tests/support/passages.h"

namespace phongpd {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::Vector3d;

// A planner and its problem; T is the planner.
template <typename T>
struct Setup {
  explicit Setup(const testing::Passage& passage, std::uint64_t seed = 1)
      : si(MakeSpaceInformation(passage.model)),
        problem(std::make_shared<ob::ProblemDefinition>(si)),
        planner(std::make_shared<T>(si, passage.model)) {
    ob::ScopedState<> start(si), goal(si);
    FromPoint(passage.scene.start, start.get());
    FromPoint(passage.scene.goal, goal.get());
    problem->setStartAndGoalStates(start, goal);
    planner->setProblemDefinition(problem);
    planner->setSeed(seed);
    planner->setup();
  }

  ob::PlannerStatus Solve(double seconds) {
    return planner->solve(ob::timedPlannerTerminationCondition(seconds));
  }

  std::vector<Vector3d> Path() const {
    std::vector<Vector3d> points;
    auto* path = problem->getSolutionPath()->template as<og::PathGeometric>();
    for (const ob::State* state : path->getStates()) {
      points.push_back(ToPoint(state));
    }
    return points;
  }

  ob::SpaceInformationPtr si;
  ob::ProblemDefinitionPtr problem;
  std::shared_ptr<T> planner;
};

template <typename T>
class RetractionPlanners : public ::testing::Test {};
using Planners = ::testing::Types<RetractionRRT, RetractionForest>;
// The comma: clang wants every variadic argument there.
TYPED_TEST_SUITE(RetractionPlanners, Planners, );

TYPED_TEST(RetractionPlanners, SolveNarrowPassagesWithFreePaths) {
  for (const char* family :
       {"gap", "hole", "tunnel", "keyhole", "comb", "snake", "bugtrap"}) {
    for (const int turned : {0, 1}) {
      const testing::Passage passage =
          testing::MakePassage(family, 1e-3, turned);
      Setup<TypeParam> setup(passage);
      ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION)
          << family << turned;
      const std::vector<Vector3d> path = setup.Path();
      EXPECT_EQ(path.front(), passage.scene.start);
      EXPECT_EQ(path.back(), passage.scene.goal);
      EXPECT_TRUE(CheckPath(passage.model->free_space(), path).free);
      EXPECT_TRUE(setup.problem->getSolutionPath()->check());
    }
  }
}

// The slide from a goal to the same start is one point, which joined nothing:
// the path went to a sample and back.
TYPED_TEST(RetractionPlanners, StayWhereStartIsGoal) {
  testing::Passage passage = testing::MakePassage("hole", 1e-2);
  passage.scene.goal = passage.scene.start;
  Setup<TypeParam> setup(passage);
  ASSERT_EQ(setup.Solve(1.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(setup.planner->samples(), 0u);
  EXPECT_EQ(setup.Path(),
            std::vector<Vector3d>({passage.scene.start, passage.scene.start}));
}

TYPED_TEST(RetractionPlanners, DependNeitherOnUnitNorOnOrigin) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double offset : {0.0, 1e3}) {
      for (const char* family : {"hole", "tunnel"}) {
        const testing::Passage passage =
            testing::MakePassage(family, {{"delta", 1e-3},
                                          {"scale", scale},
                                          {"offset", offset * scale},
                                          {"rotation_seed", 1}});
        Setup<TypeParam> setup(passage);
        ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION)
            << family << scale << ' ' << offset;
        EXPECT_LT(setup.planner->samples(), 200u);
        EXPECT_TRUE(CheckPath(passage.model->free_space(), setup.Path()).free);
      }
    }
  }
}

TYPED_TEST(RetractionPlanners, NeverSolveInfeasibleTwins) {
  int runs = 0;
  for (const char* family : {"hole", "tunnel", "keyhole"}) {
    for (const int turned : {0, 1, 2}) {
      const testing::Passage passage =
          testing::MakePassage(family, -1e-4, turned);
      for (std::uint64_t seed = 1; seed <= 4; ++seed, ++runs) {
        Setup<TypeParam> setup(passage, seed);
        EXPECT_EQ(setup.Solve(0.03), ob::PlannerStatus::TIMEOUT)
            << family << turned;
        EXPECT_FALSE(setup.problem->hasSolution());
      }
    }
  }
  EXPECT_EQ(runs, 36);
}

// It looks whether it is to stop all the time: what it does after it is told so
// is at most what it does between two looks.
TYPED_TEST(RetractionPlanners, StopWhenTold) {
  const testing::Passage passage = testing::MakePassage("tunnel", -1e-4);
  for (const int told : {1, 10, 100, 1000}) {
    Setup<TypeParam> setup(passage);
    int polls = 0;
    EXPECT_EQ(setup.planner->solve(ob::PlannerTerminationCondition(
                  [&] { return ++polls >= told; })),
              ob::PlannerStatus::TIMEOUT);
    EXPECT_GE(polls, told);
    EXPECT_LE(polls, told + 10);
    EXPECT_LE(setup.planner->samples(), static_cast<std::uint64_t>(told));
  }
}

TYPED_TEST(RetractionPlanners, ResumeAndClear) {
  const testing::Passage passage = testing::MakePassage("snake", 1e-3, 1);
  Setup<TypeParam> setup(passage);
  // A few samples at a time; the graph is kept in between.
  std::size_t points = 0;
  int calls = 0;
  ob::PlannerStatus status = ob::PlannerStatus::TIMEOUT;
  for (; calls < 2000 && !status; ++calls) {
    int polls = 0;
    status = setup.planner->solve(
        ob::PlannerTerminationCondition([&polls] { return ++polls > 12; }));
    ASSERT_GE(setup.planner->graph().points().size(), points);
    points = setup.planner->graph().points().size();
  }
  EXPECT_EQ(status, ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_GT(calls, 1);
  EXPECT_TRUE(CheckPath(passage.model->free_space(), setup.Path()).free);
  // Solved stays solved; cleared starts anew.
  EXPECT_EQ(setup.Solve(0.0), ob::PlannerStatus::EXACT_SOLUTION);
  setup.planner->clear();
  EXPECT_TRUE(setup.planner->graph().points().empty());
  EXPECT_EQ(setup.planner->samples(), 0u);
  setup.problem->clearSolutionPaths();
  EXPECT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_TRUE(CheckPath(passage.model->free_space(), setup.Path()).free);
}

TYPED_TEST(RetractionPlanners, RepeatWithTheSeed) {
  const testing::Passage passage = testing::MakePassage("bugtrap", 1e-3);
  for (const char* choice : {"all", "random", "novelty"}) {
    std::vector<std::vector<Vector3d>> paths;
    std::vector<std::uint64_t> samples;
    for (const std::uint64_t seed : {7u, 7u, 8u}) {
      Setup<TypeParam> setup(passage, seed);
      setup.planner->params().setParam("choice", choice);
      ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION) << choice;
      paths.push_back(setup.Path());
      samples.push_back(setup.planner->samples());
    }
    EXPECT_EQ(paths[0], paths[1]) << choice;
    EXPECT_EQ(samples[0], samples[1]);
    EXPECT_NE(paths[0], paths[2]) << choice;
  }
}

TYPED_TEST(RetractionPlanners, GiveDataWhoseEdgesAreValidMotions) {
  const testing::Passage passage = testing::MakePassage("keyhole", 1e-3);
  Setup<TypeParam> setup(passage);
  ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION);
  ob::PlannerData data(setup.si);
  setup.planner->getPlannerData(data);
  EXPECT_EQ(data.numVertices(), setup.planner->graph().points().size());
  EXPECT_EQ(data.numEdges(), setup.planner->graph().edges().size());
  EXPECT_EQ(data.numStartVertices(), 1u);
  EXPECT_EQ(data.numGoalVertices(), 1u);
  for (unsigned int i = 0; i < data.numVertices(); ++i) {
    std::vector<unsigned int> neighbors;
    data.getEdges(i, neighbors);
    for (const unsigned int j : neighbors) {
      EXPECT_TRUE(setup.si->checkMotion(data.getVertex(i).getState(),
                                        data.getVertex(j).getState()));
    }
  }
  // Asked again, it adds nothing.
  setup.planner->getPlannerData(data);
  EXPECT_EQ(data.numVertices(), setup.planner->graph().points().size());
}

TYPED_TEST(RetractionPlanners, DeclareParametersAndProgress) {
  const testing::Passage passage = testing::MakePassage("hole", 1e-2);
  Setup<TypeParam> setup(passage);
  ob::ParamSet& params = setup.planner->params();
  for (const char* name :
       {"metric", "choice", "clearance", "local_planner", "seed"}) {
    ASSERT_TRUE(params.hasParam(name)) << name;
    EXPECT_FALSE(params[name].getRangeSuggestion().empty()) << name;
    EXPECT_TRUE(params.setParam(name, params[name].getValue())) << name;
  }
  EXPECT_THROW(params.setParam("local_planner", "fly"), InputError);
  EXPECT_THROW(params.setParam("clearance", "2"), InputError);
  const auto& properties = setup.planner->getPlannerProgressProperties();
  EXPECT_EQ(properties.count("samples INTEGER"), 1u);
  ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(properties.at("graph states INTEGER")(),
            std::to_string(setup.planner->graph().points().size()));
}

TYPED_TEST(RetractionPlanners, RefuseWhatTheyCannotPlan) {
  testing::Passage passage = testing::MakePassage("hole", 1e-2);
  {
    Setup<TypeParam> setup(passage);
    ob::ScopedState<> inside(setup.si);
    FromPoint({0.0, 0.0, 0.0}, inside.get());
    setup.problem->setStartAndGoalStates(inside, inside);
    setup.planner->clear();
    EXPECT_EQ(setup.Solve(0.1), ob::PlannerStatus::INVALID_START);
  }
  passage.scene.goal.setZero();
  EXPECT_EQ(Setup<TypeParam>(passage).Solve(0.1),
            ob::PlannerStatus::INVALID_GOAL);
  const auto circle = std::make_shared<ob::SpaceInformation>(
      std::make_shared<ob::SO2StateSpace>());
  circle->setStateValidityChecker([](const ob::State*) { return true; });
  circle->setup();
  TypeParam planner(circle, passage.model);
  auto problem = std::make_shared<ob::ProblemDefinition>(circle);
  ob::ScopedState<> state(circle);
  problem->setStartAndGoalStates(state, state);
  planner.setProblemDefinition(problem);
  EXPECT_THROW(planner.solve(0.1), InputError);
}

TYPED_TEST(RetractionPlanners, TakeSeveralStartsAndGoals) {
  // One start is shut off from all goals, one goal from all starts.
  const testing::Passage passage = testing::MakePassage("hole", -1e-4);
  Setup<TypeParam> setup(passage);
  ob::ScopedState<> start(setup.si), goal(setup.si);
  FromPoint(passage.scene.goal + Vector3d(0.0, 0.3, 0.2), start.get());
  setup.problem->addStartState(start);
  EXPECT_EQ(setup.Solve(2.0), ob::PlannerStatus::EXACT_SOLUTION);
  EXPECT_EQ(setup.Path().front(), ToPoint(start.get()));
}

// Another judge beside the contact space: every motion must pass it too.
class OnlyUpperHalf : public ContactSpaceMotionValidator {
 public:
  OnlyUpperHalf(const ob::SpaceInformationPtr& si, const testing::Passage& p)
      : ContactSpaceMotionValidator(si, p.model) {}
  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return ToPoint(a).y() > -0.1 && ToPoint(b).y() > -0.1 &&
           ContactSpaceMotionValidator::checkMotion(a, b);
  }
};

TYPED_TEST(RetractionPlanners, ObeyAnotherMotionValidator) {
  const testing::Passage passage = testing::MakePassage("keyhole", 1e-2);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Setup<TypeParam> setup(passage, seed);
    setup.si->setMotionValidator(
        std::make_shared<OnlyUpperHalf>(setup.si, passage));
    setup.si->setup();
    setup.planner->setup();
    ASSERT_EQ(setup.Solve(5.0), ob::PlannerStatus::EXACT_SOLUTION);
    for (const Vector3d& q : setup.Path()) EXPECT_GT(q.y(), -0.1);
  }
}

// Run under the thread sanitizer as well.
TYPED_TEST(RetractionPlanners, ShareTheModelBetweenThreads) {
  const testing::Passage passage = testing::MakePassage("tunnel", 1e-3);
  std::vector<std::vector<Vector3d>> paths(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    threads.emplace_back([&, i] {
      Setup<TypeParam> setup(passage, 1 + i / 2);
      if (setup.Solve(20.0)) paths[i] = setup.Path();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& path : paths) {
    EXPECT_TRUE(CheckPath(passage.model->free_space(), path).free);
  }
  EXPECT_EQ(paths[0], paths[1]);
  EXPECT_EQ(paths[2], paths[3]);
}

}  // namespace
}  // namespace phongpd
