// SPDX-License-Identifier: GPL-3.0-or-later
// Planning in free space alone.  Truth: exact motion checks on the original
// solids (MotionOracle) and in the whole contact space.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "constraints/motion_oracle.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_refusal.h"
#include "problems/scenes/scene.h"
#include "problems/scenes/scene_source.h"
#include "problems/shapes/random_solids.h"
#include "problems/studies/planner_names.h"
#include "problems/studies/planning_study.h"

namespace phongpd {
namespace {

using Eigen::Vector3d;

// With the model's name.
Scene SceneOf(const std::string& name, const std::string& model) {
  Scene scene = SceneSource(name).Load();
  scene.planning.model = model;
  return scene;
}

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
    const Scene scene = SceneOf(name, "window");
    PlanningStudy study(scene);
    PlanningRun run;
    run.planner = "rrt-connect";
    run.time_limit = 20.0;
    const PlanningResult result = study.Run(run);
    EXPECT_EQ(result.model, "window");
    ASSERT_TRUE(result.solved) << result.status;
    EXPECT_EQ(study.world().Report().contact_spaces, 0);
    EXPECT_EQ(study.world().Report().convolutions, 1);

    const std::vector<Vector3d>& path = result.numbers.path;
    EXPECT_EQ(path.front(), scene.start);
    EXPECT_EQ(path.back(), scene.goal);
    for (const Solid& obstacle : scene.workspace.obstacles) {
      const MotionOracle oracle(scene.workspace.robot, obstacle);
      for (std::size_t k = 0; k + 1 < path.size(); ++k) {
        EXPECT_FALSE(oracle.Collides(path[k], path[k + 1])) << obstacle.name();
      }
    }
    const FreeSpace& full = *study.spaces().free_space;
    EXPECT_TRUE(CheckPath(full, path).free);
    EXPECT_NEAR(PathClearance(full, path), result.numbers.clearance,
                1e-11 * study.world().diagonal());
    EXPECT_EQ(PathLength(path), result.numbers.length);
  }
}

TEST(PlanningModel, ShorteningKeepsClearanceAndEnds) {
  const Scene scene = SceneOf("hole:delta=0.1", "window");
  PlanningStudy study(scene);
  double shortest = 1e300;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    PlanningRun run;
    run.planner = "rrt-connect";
    run.time_limit = 20.0;
    run.seed = seed;
    const PlanningResult result = study.Run(run);
    ASSERT_TRUE(result.solved);
    EXPECT_GT(result.numbers.clearance, 1e-4);
    shortest = std::min(shortest, result.numbers.length);
  }
  EXPECT_LT(shortest, 1.3 * PathLength(scene.witness));
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
  PlanningRun run;
  run.time_limit = 20.0;
  PlanningStudy automatic(SceneOf("hole:delta=0.1", "auto"), {}, limits);
  const PlanningResult result = automatic.Run(run);
  EXPECT_TRUE(result.solved);
  EXPECT_EQ(result.model, "window");
  EXPECT_EQ(result.planner, "contact-surface");
  EXPECT_NE(automatic.refusal().find("max_mib"), std::string::npos);
  run.planner = "retraction-forest";
  EXPECT_THROW(automatic.Run(run), BuildRefusal);
  PlanningStudy full(SceneOf("hole:delta=0.1", "full"), {}, limits);
  EXPECT_THROW(full.Run(run), BuildRefusal);
  PlanningStudy window(SceneOf("hole:delta=0.1", "window"), {}, limits);
  EXPECT_THROW(window.Run(run), InputError);  // of the same planner
  EXPECT_THROW(PlanningStudy(SceneOf("hole:delta=0.1", "some")), InputError);
}

TEST(PlanningModel, AutoBuildsNoContactSpaceForWhoNeedsNone) {
  PlanningStudy study(SceneOf("hole:delta=0.1", "auto"));
  PlanningRun sampler, exact;
  sampler.planner = "rrt-connect";
  sampler.time_limit = 20.0;
  // Known before any run: all of them may be kept from before.
  EXPECT_TRUE(study.RunsInWindow(sampler));
  const PlanningResult first = study.Run(sampler);
  EXPECT_TRUE(first.solved);
  EXPECT_EQ(first.model, "window");
  EXPECT_EQ(study.world().Report().contact_spaces, 0);
  const PlanningResult second = study.Run(exact);
  EXPECT_TRUE(second.solved);
  EXPECT_EQ(second.model, "full");
  // What is there already is cheaper than anything.
  EXPECT_EQ(study.Run(sampler).model, "full");
  EXPECT_EQ(study.world().Report().contact_spaces, 1);
  EXPECT_EQ(study.refusal(), "");
}

TEST(SurfaceFreePlanners, AreRefusedNothingButTheSurface) {
  const Scene scene = SceneOf("hole:delta=0.1", "window");
  PlanningStudy study(scene);
  const MotionDomain domain = {study.world().Convolution().free_space,
                               scene.workspace.bounds};
  for (const std::string& name : OmplPlannerNames()) {
    OmplPlanningOptions options;
    options.time_limit = 0.2;
    if (NeedsWholeSurface(name)) {
      EXPECT_THROW(PlanWithOmpl(domain, scene.start, scene.goal, name, options),
                   InputError)
          << name;
    } else {
      EXPECT_NO_THROW(
          PlanWithOmpl(domain, scene.start, scene.goal, name, options))
          << name;
    }
  }
  EXPECT_THROW(PlanWithOmpl(MotionDomain(), scene.start, scene.goal, "prm"),
               InputError);
}

}  // namespace
}  // namespace phongpd
