// SPDX-License-Identifier: GPL-3.0-or-later
// Truth: the same request on the whole contact space.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/mesh/mesh_error.h"
#include "planners/solve/optimize.h"
#include "tests/support/staged.h"

namespace phongpd {
namespace {

struct StagedWindow : testing::Staged {
  using testing::Staged::Staged;

  OptimizeRequest Request(Model model, const std::string& metric) const {
    OptimizeRequest request = testing::Staged::Request(model);
    request.penetration = ParsePenetration(metric, "metric");
    request.verifies = false;
    return request;
  }
};

double Apart(const Path& a, const Path& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    most = std::max(most, (a[i] - b[i]).norm());
  }
  return a.size() == b.size() ? most : 1e300;
}

// From the colliding line Ipopt takes the same steps; the window builds no
// contact space.
TEST(WindowMetricOfOptimize, TakesTheSolverWhereTheWholeContactSpaceDoes) {
  for (const char* metric :
       {"euclidean", "smoothed@0.02", "smoothed-foot@0.02", "smoothed@0.2"}) {
    for (const char* family : {"u_axis", "plate"}) {
      SCOPED_TRACE(std::string(metric) + " " + family);
      const StagedWindow staged(family), other(family);
      OptimizeRequest request = staged.Request(Model::kWindow, metric);
      request.options.start = TrajectoryStart::kStraight;
      request.options.start_noise = 0.003;  // off what is symmetric
      request.options.polish = PolishWhen::kNever;
      request.options.optimizer.ipopt.max_iterations = 15;
      request.options.optimizer.max_rounds = 1;
      const PathAnswer found = Optimize(staged.world, request);
      EXPECT_EQ(staged.world.Report().contact_spaces, 0);
      EXPECT_EQ(found.evidence.model, Model::kWindow);
      ASSERT_TRUE(found.windows);
      EXPECT_GT(found.windows->inside, 0U);
      EXPECT_GT(found.windows->boxes, 0U);
      request.model = Model::kFull;
      const PathAnswer whole = Optimize(other.world, request);
      EXPECT_FALSE(whole.windows);
      EXPECT_EQ(found.status, whole.status);
      EXPECT_EQ(found.pipeline->iterations, whole.pipeline->iterations);
      EXPECT_LT(Apart(found.path, whole.path), 1e-6 * staged.world.diagonal());
    }
  }
}

// What was modelled is kept with the world.
TEST(WindowMetricOfOptimize, ModelsNothingTwice) {
  const StagedWindow staged("plate");
  OptimizeRequest request = staged.Request(Model::kWindow, "euclidean");
  request.options.start = TrajectoryStart::kStraight;
  request.options.optimizer.ipopt.max_iterations = 10;
  const PathAnswer first = Optimize(staged.world, request);
  const PathAnswer again = Optimize(staged.world, request);
  EXPECT_GT(first.windows->boxes, 0U);
  EXPECT_EQ(again.windows->boxes, 0U);
  EXPECT_EQ(again.windows->extensions, 0U);
  EXPECT_EQ(again.windows->inside, first.windows->inside);
  EXPECT_EQ(again.path, first.path);
}

TEST(WindowMetricOfOptimize, AnswersByDefaultAsFreeAsTheWhole) {
  const StagedWindow staged("u_axis");
  const PathAnswer found =
      Optimize(staged.world, staged.Request(Model::kWindow, "smoothed@0.02"));
  EXPECT_TRUE(found.is_free);
  EXPECT_TRUE(found.is_solved) << found.reason;
  EXPECT_EQ(staged.world.Report().contact_spaces, 0);
  const FreeSpace& whole =
      *staged.world.Spaces(SpaceLayout::kMerged).free_space;
  EXPECT_TRUE(CheckPath(whole, found.path).free);
}

// Phong's depth, more rows, and spaces of each obstacle are followed in the
// whole alone.
TEST(WindowMetricOfOptimize, FollowsNoneWhereWindowsHaveNone) {
  const StagedWindow staged("u_axis");
  OptimizeRequest phong = staged.Request(Model::kWindow, "phong");
  OptimizeRequest rows = staged.Request(Model::kWindow, "euclidean");
  rows.options.optimizer.rows = 2;
  OptimizeRequest each = staged.Request(Model::kWindow, "euclidean");
  each.is_per_obstacle = true;
  for (const OptimizeRequest& request : {phong, rows, each}) {
    const PathAnswer found = Optimize(staged.world, request);
    EXPECT_FALSE(found.windows);
    EXPECT_TRUE(found.is_free);
    EXPECT_EQ(found.evidence.model, Model::kWindow);
  }
}

}  // namespace
}  // namespace phongpd
