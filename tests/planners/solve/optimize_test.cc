// SPDX-License-Identifier: GPL-3.0-or-later
#include "planners/solve/optimize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>

#include "constraints/free_space.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_stop.h"
#include "planners/trajectory/corridor.h"
#include "tests/support/staged.h"

namespace phongpd {
namespace {

using testing::Staged;

// Judged by what the window never built: the whole contact space.
TEST(TrajectoryModel, PathsOfTheWindowAreFreeOnTheWholeContactSpace) {
  for (const char* family : {"u_axis", "plate", "hole:delta=0.1", "clutter"}) {
    const Staged staged(family);
    const OptimizeRequest request = staged.Request(Model::kWindow);
    const PathAnswer found = Optimize(staged.world, request);
    ASSERT_EQ(found.status, PathStatus::kPolished)
        << family << ": " << found.reason;
    EXPECT_EQ(found.evidence.model, Model::kWindow);
    EXPECT_EQ(staged.world.Report().contact_spaces, 0) << family;
    ASSERT_EQ(found.path.size(),
              static_cast<std::size_t>(request.waypoints) + 2);
    const FreeSpace& whole =
        *staged.world.Spaces(SpaceLayout::kMerged).free_space;
    EXPECT_TRUE(CheckPath(whole, found.path).free) << family;
    EXPECT_NEAR(found.clearance, PathClearance(whole, found.path),
                1e-12 * staged.world.diagonal())
        << family;
    EXPECT_EQ(found.evidence.verification->verdict, Verdict::kConfirmed);
  }
}

// The corridor is the same optimiser in both models: from the same free path
// it finds the same one.
TEST(TrajectoryModel, CorridorInTheWindowIsThatOfTheWholeContactSpace) {
  const Staged staged("u_axis");
  OptimizeRequest raw = staged.Request(Model::kWindow);
  raw.options.polish = PolishWhen::kNever;
  const PathAnswer start = Optimize(staged.world, raw);
  ASSERT_EQ(start.status, PathStatus::kStalledFeasible);
  const OptimizeRequest request = staged.Request(Model::kWindow);
  const PathAnswer found = Optimize(staged.world, request);
  const CorridorSummary whole =
      PolishInCorridor(ProblemOf(staged.world, request), start.path);
  EXPECT_NEAR(found.pipeline->objective, whole.objective,
              1e-6 * whole.objective);
}

// In a tunnel Ipopt leaves a start that goes through, and converges to a way
// around that keeps clear at more than twice the energy; the corridor gives the
// start its clearance, and the way through is what is returned.
TEST(TrajectoryModel, KeepsTheWayOfTheStartWhereIpoptTakesAWorseOne) {
  int left = 0;
  for (const std::uint64_t seed : {106, 110, 112, 114}) {
    const Scene scene = SceneSource("peg_tunnel:clearance=0.1").Load(seed);
    OptimizeRequest request = OptimizeRequestOf(scene);
    request.options.seed = seed;
    const PathAnswer answer = Optimize(World(scene.workspace), request);
    EXPECT_EQ(answer.status, PathStatus::kPolished) << seed;
    const PipelineResult& found = *answer.pipeline;
    EXPECT_LE(found.missing_clearance, 1e-3) << seed;
    ASSERT_EQ(found.stages[0].status, "repaired");
    EXPECT_LE(found.objective, 1.05 * found.stages[0].objective) << seed;
    left += found.stages[1].stage == "ipopt" && found.stages[1].is_free &&
            found.stages[1].objective > 1.5 * found.stages[0].objective;
  }
  EXPECT_GE(left, 3);  // or nothing of this was tried
}

TEST(TrajectoryModel, AutoIsFullAndFullIsRefusedAtALimit) {
  WorldLimits tight;
  tight.max_mib = 1e-3;
  const Staged roomy("u_axis"), narrow("u_axis", tight);
  const PathAnswer full = Optimize(roomy.world, roomy.Request(Model::kAuto));
  EXPECT_EQ(full.evidence.model, Model::kFull);
  EXPECT_TRUE(full.evidence.refusal.empty());
  EXPECT_THROW(Optimize(narrow.world, narrow.Request(Model::kFull)),
               BuildRefusal);
}

TEST(TrajectoryModel, WindowSaysWhatItCannotDo) {
  const Staged staged("u_axis");
  OptimizeRequest straight = staged.Request(Model::kWindow);
  straight.options.start = TrajectoryStart::kStraight;
  const PathAnswer colliding = Optimize(staged.world, straight);
  EXPECT_EQ(colliding.status, PathStatus::kFailed);
  EXPECT_NE(colliding.reason.find("the line collides"), std::string::npos);
  EXPECT_TRUE(colliding.path.empty());

  const Staged closed("hole:twin=1");
  OptimizeRequest request = closed.Request(Model::kWindow);
  request.search_time = 0.2;
  const PathAnswer none = Optimize(closed.world, request);
  EXPECT_EQ(none.status, PathStatus::kFailed);
  EXPECT_NE(none.reason.find("proves nothing"), std::string::npos);
}

TEST(TrajectoryModel, RepeatsToTheByteInTheWindow) {
  const Staged one("plate"), other("plate");
  OptimizeRequest request = one.Request(Model::kWindow);
  request.options.routes = 3;
  request.options.seed = 7;
  const PathAnswer a = Optimize(one.world, request);
  const PathAnswer b = Optimize(other.world, request);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.pipeline->route, b.pipeline->route);
  // More routes are never worse.
  request.options.routes = 1;
  const PathAnswer first = Optimize(one.world, request);
  EXPECT_LE(a.pipeline->objective, first.pipeline->objective * (1.0 + 1e-12));
}

// The three sketches: a plan, a polyline, and with limits a motion in time.
TEST(Optimize, AnswersWithAMotionWhereThereAreLimits) {
  const Staged staged("u_axis");
  OptimizeRequest request;
  request.start = staged.scene.start;
  request.goal = staged.scene.goal;
  const PathAnswer polyline = Optimize(staged.world, request);
  EXPECT_TRUE(polyline.is_solved) << polyline.reason;
  EXPECT_TRUE(polyline.motion.empty());
  EXPECT_TRUE(polyline.pipeline && !polyline.curve);
  request.limits.emplace();
  request.limits->velocity.setConstant(1.0);
  request.limits->acceleration.setConstant(2.0);
  request.limits->jerk.setConstant(10.0);
  request.preset = Preset::kFast;
  const PathAnswer motion = Optimize(staged.world, request);
  EXPECT_TRUE(motion.is_solved) << motion.reason;
  EXPECT_TRUE(motion.evidence.use.IsKept());
  EXPECT_EQ(motion.evidence.verification->verdict, Verdict::kConfirmed);
  EXPECT_EQ(motion.motion.At(0.0).position, request.start);
  EXPECT_EQ(motion.motion.At(motion.motion.duration()).position, request.goal);
  // The same path again by the other door.
  const PathAnswer again = Retime(staged.world, motion.path, request);
  EXPECT_TRUE(again.is_solved);
  EXPECT_EQ(again.path, motion.path);
  EXPECT_THROW(Retime(staged.world, {}, request), InputError);
  request.limits.reset();
  EXPECT_THROW(Retime(staged.world, motion.path, request), InputError);
}

// A world keeps metrics by their names: another length is another metric.
TEST(Optimize, FollowsTheMetricOfEachRequest) {
  const Staged used("u_axis");
  for (const char* name : {"phong@0.2", "euclidean", "phong@0.1",
                           "phong@0.2/exact", "phong@0.2"}) {
    SCOPED_TRACE(name);
    const Staged fresh("u_axis");
    OptimizeRequest request = used.Request(Model::kFull);
    request.penetration = ParsePenetration(name, "metric");
    request.options.start = TrajectoryStart::kStraight;
    request.options.polish = PolishWhen::kNever;
    request.options.optimizer.ipopt.max_iterations = 30;
    EXPECT_EQ(Optimize(used.world, request).path,
              Optimize(fresh.world, request).path);
    EXPECT_EQ(request.penetration.Name(), name);
  }
}

// The way that a single route takes is one of them.
TEST(Optimize, SeveralRoutesOfAMotionAreNeverSlower) {
  int gained = 0;
  for (const char* family : {"u_axis", "clutter", "knot"}) {
    SCOPED_TRACE(family);
    const Staged staged(family);
    OptimizeRequest request = staged.Request(Model::kFull);
    ApplyPreset(Preset::kFast, &request);
    // All keep that: what is compared is time.
    request.margin = Length::FromShare(1e-6);
    request.limits.emplace();
    request.limits->velocity.setConstant(1.0);
    request.limits->acceleration.setConstant(2.0);
    request.limits->jerk.setConstant(10.0);
    const PathAnswer one = Optimize(staged.world, request);
    ASSERT_TRUE(one.is_solved) << one.reason;
    EXPECT_EQ(one.routes, 1);
    request.options.routes = 4;
    const PathAnswer best = Optimize(staged.world, request);
    ASSERT_TRUE(best.is_solved) << best.reason;
    EXPECT_GE(best.routes, one.routes);
    EXPECT_LE(best.motion.duration(), one.motion.duration());
    EXPECT_EQ(best.evidence.verification->verdict, Verdict::kConfirmed);
    gained += best.routes > 1;
  }
  EXPECT_GT(gained, 0);  // or no scene has several
}

}  // namespace
}  // namespace phongpd
