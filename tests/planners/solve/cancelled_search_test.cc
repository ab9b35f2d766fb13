// SPDX-License-Identifier: GPL-3.0-or-later
// Searches that build nothing any more, stopped by another thread.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>

#include "core/minkowski/build_stop.h"
#include "planners/solve/plan.h"
#include "problems/scenes/scene_requests.h"
#include "problems/scenes/scene_source.h"

namespace phongpd {
namespace {

// Calls CancelBuilds without a pause while it lives.
class Canceller {
 public:
  Canceller() {
    while (!has_begun_) std::this_thread::yield();
  }
  ~Canceller() {
    is_over_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> has_begun_{false}, is_over_{false};
  std::thread thread_{[this] {
    while (!is_over_) {
      CancelBuilds();
      has_begun_ = true;
    }
  }};
};

// What it says that stopped it.  On a machine with other work the other thread
// may not run in time: tried again.
template <typename Ask>
std::string WhatStopped(const Ask& ask) {
  constexpr int kTries = 10'000;
  const Canceller canceller;
  for (int i = 0; i < kTries; ++i) {
    try {
      ask();
    } catch (const BuildCancelled& error) {
      return error.what();
    }
  }
  return "nothing did";
}

TEST(CancelWatch, KnowsOnlyWhatCameAfterIt) {
  CancelBuilds();
  const CancelWatch watch;
  EXPECT_FALSE(watch.IsCancelled());
  EXPECT_NO_THROW(watch.Check("it"));
  CancelBuilds();
  EXPECT_TRUE(watch.IsCancelled());
  EXPECT_FALSE(CancelWatch().IsCancelled());
  try {
    watch.Check("it");
    FAIL() << "expected BuildCancelled";
  } catch (const BuildCancelled& error) {
    EXPECT_STREQ(error.what(), "it was cancelled");
  }
}

TEST(CancelledSearch, StopsWhereEverythingIsBuiltAndHarmsNoLaterOne) {
  SilenceOmpl();
  const Scene scene = SceneSource("u_axis").Load();
  const World world(scene.workspace, scene.name, {});
  PlanRequest plan = PlanRequestOf(scene);
  plan.model = Model::kFull;
  const PathAnswer first = Plan(world, plan);
  ASSERT_TRUE(first.is_solved) << first.reason;
  EXPECT_EQ(WhatStopped([&] { Plan(world, plan); }),
            "the search for routes was cancelled");
  EXPECT_EQ(Plan(world, plan).path, first.path);
}

// Without the watch it would go on for a day, and the test with it.
TEST(CancelledSearch, StopsASamplerThatFindsNothing) {
  SilenceOmpl();
  const Scene scene = SceneSource("tunnel:delta=0.001,bends=3,twin=1").Load();
  const World world(scene.workspace, scene.name, {});
  for (const PlannerId planner :
       {PlannerId::kRrtConnect, PlannerId::kRetractionForest}) {
    PlanRequest request = PlanRequestOf(scene);
    request.planner = planner;
    request.time_limit = 0.05;
    ASSERT_FALSE(Plan(world, request).is_solved);  // all is built
    request.time_limit = 86400.0;
    EXPECT_EQ(WhatStopped([&] { Plan(world, request); }),
              "the search of the sampler was cancelled");
  }
}

}  // namespace
}  // namespace phongpd
