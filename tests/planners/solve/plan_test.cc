// SPDX-License-Identifier: GPL-3.0-or-later
// Plan, above all in free space alone.  Truth: exact motion checks on the
// original solids (MotionOracle) and in the whole contact space.
#include "planners/solve/plan.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "constraints/motion_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "problems/shapes/random_solids.h"
#include "tests/support/staged.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

struct StagedPlan : testing::Staged {
  using testing::Staged::Staged;

  PlanRequest Request(PlannerId planner, Model model) const {
    PlanRequest request = PlanRequestOf(scene);
    request.planner = planner;
    request.model = model;
    request.time_limit = 20.0;
    return request;
  }
};

// What is in help is in scenes, and the other way round.
TEST(PlanningModel, ScenesTakeEveryPlannerByTheNamesOfHelp) {
  const auto& planning = SceneSchema().at(
      nlohmann::ordered_json::json_pointer("/properties/planning/properties"));
  EXPECT_EQ(planning["planner"]["enum"].get<std::vector<std::string>>(),
            PlannerNames());
}

TEST(PlanningModel, WindowPathsAreExactlyFree) {
  SilenceOmpl();
  for (const std::string name :
       {"ball_wrench", "hole:delta=0.1", "gap:delta=0.1,rotation_seed=1",
        "torus_hole", "cone_axes", "clutter"}) {
    SCOPED_TRACE(name);
    const StagedPlan staged(name);
    const Scene& scene = staged.scene;
    const PathAnswer answer = Plan(
        staged.world, staged.Request(PlannerId::kRrtConnect, Model::kWindow));
    EXPECT_EQ(answer.evidence.model, Model::kWindow);
    ASSERT_TRUE(answer.is_solved) << answer.plan->search.status;
    EXPECT_EQ(staged.world.Report().contact_spaces, 0);
    EXPECT_EQ(staged.world.Report().convolutions, 1);
    EXPECT_EQ(answer.evidence.verification->verdict, Verdict::kConfirmed);

    const std::vector<Vector3d>& path = answer.path;
    EXPECT_EQ(path.front(), scene.start);
    EXPECT_EQ(path.back(), scene.goal);
    for (const Solid& obstacle : scene.workspace.obstacles) {
      const MotionOracle oracle(scene.workspace.robot, obstacle);
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        EXPECT_FALSE(oracle.Collides(path[k], path[k + 1])) << obstacle.name();
      }
    }
    const FreeSpace& full =
        *staged.world.Spaces(SpaceLayout::kSealed).free_space;
    EXPECT_TRUE(CheckPath(full, path).free);
    EXPECT_NEAR(PathClearance(full, path), answer.clearance,
                1e-11 * staged.world.diagonal());
    EXPECT_EQ(PathLength(path), answer.length);
  }
}

TEST(PlanningModel, ShorteningKeepsClearanceAndEnds) {
  const StagedPlan staged("hole:delta=0.1");
  PlanRequest request = staged.Request(PlannerId::kRrtConnect, Model::kWindow);
  double shortest = 1e300;
  for (request.seed = 1; request.seed <= 3; ++request.seed) {
    const PathAnswer answer = Plan(staged.world, request);
    ASSERT_TRUE(answer.is_solved);
    EXPECT_GT(answer.clearance, 1e-4);
    shortest = std::min(shortest, answer.length);
  }
  EXPECT_LT(shortest, 1.3 * PathLength(staged.scene.witness));
}

TEST(PlanningModel, WorldsConvolutionIsTheFreeSpaceOfItsContactSpace) {
  for (const std::string name : {"clutter", "hole:rotation_seed=2"}) {
    SCOPED_TRACE(name);
    const Scene scene = SceneSource(name).Load();
    const World world(scene.workspace, scene.name);
    EXPECT_EQ(world.BuiltConvolution(), nullptr);
    std::vector<const WorldConvolution*> seen(4);
    std::vector<std::thread> threads;
    for (const WorldConvolution*& one : seen) {
      threads.emplace_back([&] { one = &world.Convolution(); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const WorldConvolution* one : seen) EXPECT_EQ(one, seen.front());
    EXPECT_EQ(world.Report().convolutions, 1);
    EXPECT_EQ(world.Report().contact_spaces, 0);
    const FreeSpace& found = *world.Convolution().free_space;
    const FreeSpace& truth = *world.Spaces(SpaceLayout::kMerged).free_space;
    BoundingBox box = world.workspace().bounds;
    if (box.IsEmpty()) box = world.Convolution().models.front().bounds();
    std::mt19937_64 random(3);
    int free = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vector3d a = RandomPoint(box, &random);
      const Vector3d b = a + 0.2 * (RandomPoint(box, &random) - a);
      ASSERT_EQ(found.IsFree(a, b), truth.IsFree(a, b))
          << a.transpose() << " to " << b.transpose();
      if (!truth.IsFree(a, b)) continue;
      ++free;
      EXPECT_NEAR(found.Clearance(a, b), truth.Clearance(a, b),
                  1e-12 * world.diagonal());
    }
    EXPECT_GT(free, 100);
  }
}

TEST(PlanningModel, LimitsRefuseTheContactSpaceOnly) {
  const WorldLimits limits = {0.0, 3.0};
  const auto ask = [&](PlannerId planner, Model model) {
    const StagedPlan staged("hole:delta=0.1", limits);
    return Plan(staged.world, staged.Request(planner, model));
  };
  const PathAnswer answer = ask(PlannerId::kContactSurface, Model::kAuto);
  EXPECT_TRUE(answer.is_solved);
  EXPECT_EQ(answer.evidence.model, Model::kWindow);
  EXPECT_EQ(answer.plan->planner, PlannerId::kContactSurface);
  EXPECT_NE(answer.evidence.refusal.find("max_mib"), std::string::npos);
  const PlannerId retraction = PlannerId::kRetractionForest;
  EXPECT_THROW(ask(retraction, Model::kAuto), BuildRefusal);
  EXPECT_THROW(ask(retraction, Model::kFull), BuildRefusal);
  EXPECT_THROW(ask(retraction, Model::kWindow), InputError);
  EXPECT_THROW(ParseModel("some", "model"), InputError);
}

TEST(PlanningModel, AutoBuildsNoContactSpaceForWhoNeedsNone) {
  const StagedPlan staged("hole:delta=0.1");
  const World& world = staged.world;
  const PlanRequest sampler =
      staged.Request(PlannerId::kRrtConnect, Model::kAuto);
  const PlanRequest exact =
      staged.Request(PlannerId::kContactSurface, Model::kAuto);
  // Known before any run: all of them may be kept from before.
  EXPECT_TRUE(PlansInWindow(world, sampler));
  const PathAnswer first = Plan(world, sampler);
  EXPECT_TRUE(first.is_solved);
  EXPECT_EQ(first.evidence.model, Model::kWindow);
  EXPECT_EQ(world.Report().contact_spaces, 0);
  const PathAnswer second = Plan(world, exact);
  EXPECT_TRUE(second.is_solved);
  EXPECT_EQ(second.evidence.model, Model::kFull);
  // What is there already is cheaper than anything.
  EXPECT_EQ(Plan(world, sampler).evidence.model, Model::kFull);
  EXPECT_EQ(world.Report().contact_spaces, 1);
  EXPECT_EQ(second.evidence.refusal, "");
}

TEST(SurfaceFreePlanners, AreRefusedNothingButTheSurface) {
  const StagedPlan staged("hole:delta=0.1");
  const Scene& scene = staged.scene;
  const MotionDomain domain = {staged.world.Convolution().free_space,
                               scene.workspace.bounds};
  for (const PlannerId planner : AllPlanners()) {
    OmplPlanningOptions options;
    options.time_limit = 0.2;
    const auto ask = [&] {
      PlanWithOmpl(domain, scene.start, scene.goal, planner, options);
    };
    if (ChecksMotionsOnly(planner)) {
      EXPECT_NO_THROW(ask()) << ToString(planner);
    } else {
      EXPECT_THROW(ask(), InputError) << ToString(planner);
    }
  }
  EXPECT_THROW(
      PlanWithOmpl(MotionDomain(), scene.start, scene.goal, PlannerId::kPrm),
      InputError);
}

// Of a world kept between requests nothing changes an answer.
TEST(Plan, AnswersTheSameInAWorldThatAnsweredOthersBefore) {
  const StagedPlan fresh("hole:delta=0.1"), used("hole:delta=0.1");
  PlanRequest other = used.Request(PlannerId::kContactSurface, Model::kAuto);
  std::swap(other.start, other.goal);
  other.preset = Preset::kTight;
  EXPECT_TRUE(Plan(used.world, other).is_solved);
  for (const PlannerId planner :
       {PlannerId::kContactSurface, PlannerId::kRetractionForest}) {
    for (const Model model : {Model::kFull, Model::kWindow}) {
      if (Retracts(planner) && model == Model::kWindow) continue;
      const PathAnswer a = Plan(fresh.world, fresh.Request(planner, model));
      const PathAnswer b = Plan(used.world, used.Request(planner, model));
      EXPECT_EQ(a.path, b.path) << ToString(planner) << ToString(model);
      EXPECT_EQ(a.clearance, b.clearance);
      EXPECT_EQ(a.status, PathStatus::kSolved);
    }
  }
}

// Truth: half of what the hole or the passage is wider than the robot.
TEST(Plan, KeepsARequiredClearanceThatThereIsRoomFor) {
  struct Case {
    std::string scene;
    double most;
  };
  for (const Case& c : {Case{"hole:delta=0.05", 0.025},
                        Case{"plate_hole", 0.28}, Case{"u_trap", 0.3}}) {
    const StagedPlan staged(c.scene);
    for (const Model model : {Model::kFull, Model::kWindow}) {
      PlanRequest request = staged.Request(PlannerId::kContactSurface, model);
      request.requires_clearance = true;
      for (const double share : {0.1, 0.5, 0.8, 0.95}) {
        request.clearance = Length::FromUnit(share * c.most);
        const PathAnswer answer = Plan(staged.world, request);
        EXPECT_EQ(answer.status, PathStatus::kSolved)
            << c.scene << ' ' << ToString(model) << ' ' << share << ' '
            << answer.reason;
        EXPECT_EQ(*answer.wish.shortfall, 0.0);
      }
    }
  }
}

TEST(Plan, TellsARequiredClearanceThatIsMissed) {
  const StagedPlan staged("hole:delta=0.1");
  PlanRequest request =
      staged.Request(PlannerId::kContactSurface, Model::kFull);
  request.requires_clearance = true;
  EXPECT_THROW(Plan(staged.world, request), InputError);  // of which one?
  request.clearance = Length::FromUnit(0.2);              // the hole has 0.05
  const PathAnswer missed = Plan(staged.world, request);
  EXPECT_EQ(missed.status, PathStatus::kClearanceMissed);
  EXPECT_TRUE(missed.is_free);
  EXPECT_FALSE(missed.is_solved);
  EXPECT_DOUBLE_EQ(*missed.wish.shortfall, 0.2 - missed.clearance);
  request.requires_clearance = false;
  EXPECT_EQ(Plan(staged.world, request).status, PathStatus::kSolved);
}

}  // namespace
}  // namespace phongpd
