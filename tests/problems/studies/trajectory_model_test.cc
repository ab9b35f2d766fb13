// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "constraints/free_space.h"
#include "core/mesh/mesh_error.h"
#include "core/minkowski/build_refusal.h"
#include "planners/trajectory/corridor.h"
#include "problems/scenes/scene_source.h"
#include "problems/studies/trajectory_study.h"
#include "problems/studies/window_trajectory.h"

namespace phongpd {
namespace {

Scene SceneOf(const std::string& family, const std::string& model) {
  Scene scene = SceneSource(family).Load();
  scene.trajectory.model = model;
  return scene;
}

PipelineResult RunOf(TrajectoryStudy* study, const Scene& scene,
                     const PipelineOptions& options = {}) {
  study->Enter(scene);
  return study->Run(SceneMetric(scene), options);
}

// Judged by what the window never built: the whole contact space.
TEST(TrajectoryModel, PathsOfTheWindowAreFreeOnTheWholeContactSpace) {
  for (const char* family : {"u_axis", "plate", "hole:delta=0.1", "clutter"}) {
    TrajectoryStudy study;
    const PipelineResult found = RunOf(&study, SceneOf(family, "window"));
    ASSERT_EQ(found.status, TrajectoryStatus::kPolished)
        << family << ": " << found.reason;
    EXPECT_EQ(study.model(), "window");
    EXPECT_EQ(study.world().Report().contact_spaces, 0) << family;
    ASSERT_EQ(found.path.size(),
              static_cast<std::size_t>(study.scene().trajectory.waypoints) + 2);
    const FreeSpace& whole = *study.spaces().free_space;
    EXPECT_TRUE(CheckPath(whole, found.path).free) << family;
    const double clearance = PathClearance(whole, found.path);
    EXPECT_NEAR(PathClearance(study.judge(), found.path), clearance,
                1e-12 * study.world().diagonal())
        << family;
  }
}

// The corridor is the same optimiser in both models: from the same free path
// it finds the same one.
TEST(TrajectoryModel, CorridorInTheWindowIsThatOfTheWholeContactSpace) {
  TrajectoryStudy study;
  const Scene scene = SceneOf("u_axis", "window");
  PipelineOptions raw;
  raw.polish = PolishWhen::kNever;
  const PipelineResult start = RunOf(&study, scene, raw);
  ASSERT_EQ(start.status, TrajectoryStatus::kStalledFeasible);
  const PipelineResult found = RunOf(&study, scene);
  const CorridorSummary whole =
      PolishInCorridor(study.Problem(SceneMetric(scene)), start.path);
  EXPECT_NEAR(found.objective, whole.objective, 1e-6 * whole.objective);
}

// In a tunnel Ipopt leaves a start that goes through, and converges to a way
// around that keeps clear at more than twice the energy; the corridor gives the
// start its clearance, and the way through is what is returned.
TEST(TrajectoryModel, KeepsTheWayOfTheStartWhereIpoptTakesAWorseOne) {
  int left = 0;
  for (const std::uint64_t seed : {106, 110, 112, 114}) {
    TrajectoryStudy study;
    study.Enter(SceneSource("peg_tunnel:clearance=0.1").Load(seed));
    PipelineOptions options;
    options.seed = seed;
    const PipelineResult found = study.Run(SceneMetric(study.scene()), options);
    EXPECT_EQ(found.status, TrajectoryStatus::kPolished) << seed;
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
  TrajectoryStudy free_study, tight_study({}, SpaceLayout::kMerged, tight);
  RunOf(&free_study, SceneOf("u_axis", "auto"));
  EXPECT_EQ(free_study.model(), "full");
  EXPECT_TRUE(free_study.refusal().empty());
  EXPECT_THROW(RunOf(&tight_study, SceneOf("u_axis", "full")), BuildRefusal);
  EXPECT_EQ(tight_study.model(), "none");
}

TEST(TrajectoryModel, WindowSaysWhatItCannotDo) {
  TrajectoryStudy study;
  PipelineOptions straight;
  straight.start = TrajectoryStart::kStraight;
  const PipelineResult colliding =
      RunOf(&study, SceneOf("u_axis", "window"), straight);
  EXPECT_EQ(colliding.status, TrajectoryStatus::kFailed);
  EXPECT_NE(colliding.reason.find("the line collides"), std::string::npos);
  EXPECT_TRUE(colliding.path.empty());

  Scene closed = SceneOf("hole:twin=1", "window");
  closed.planning.time_limit = 0.2;
  const PipelineResult none = RunOf(&study, closed);
  EXPECT_EQ(none.status, TrajectoryStatus::kFailed);
  EXPECT_NE(none.reason.find("proves nothing"), std::string::npos);
  EXPECT_THROW(RunOf(&study, SceneOf("u_axis", "some")), InputError);
}

TEST(TrajectoryModel, RepeatsToTheByteInTheWindow) {
  PipelineOptions options;
  options.routes = 3;
  options.seed = 7;
  TrajectoryStudy one, other;
  const PipelineResult a = RunOf(&one, SceneOf("plate", "window"), options);
  const PipelineResult b = RunOf(&other, SceneOf("plate", "window"), options);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.route, b.route);
  // More routes are never worse.
  options.routes = 1;
  const PipelineResult first = RunOf(&one, SceneOf("plate", "window"), options);
  EXPECT_LE(a.objective, first.objective * (1.0 + 1e-12));
}

}  // namespace
}  // namespace phongpd
